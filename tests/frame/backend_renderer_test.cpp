// SPDX-License-Identifier: MIT
//
// What a renderer over a backend does around its frames; the backend is the host, with memory that
// runs out.
#include "runtime/backend_renderer.hpp"

#include "conformance/stage.hpp"
#include "images/support.hpp"
#include "mir/host/backend.hpp"
#include "runtime/backend_frame/caustics.hpp"
#include "runtime/backend_frame/chains.hpp"
#include "runtime/backend_frame/chains_through.hpp"
#include "runtime/backend_frame/cuts.hpp"
#include "runtime/backend_frame/direct.hpp"
#include "runtime/backend_frame/film.hpp"
#include "runtime/backend_frame/gather.hpp"
#include "runtime/backend_frame/light.hpp"
#include "runtime/backend_frame/light_paths.hpp"
#include "runtime/backend_frame/luxels.hpp"
#include "runtime/backend_frame/residual.hpp"
#include "runtime/backend_frame/response.hpp"
#include "runtime/backend_frame/scene.hpp"
#include "runtime/backend_frame/visibility.hpp"
#include "support/catch.hpp"

namespace {

using mir::InlineExecutor;
using mir::RenderSettings;

InlineExecutor& shared_executor() {
    static InlineExecutor executor;
    return executor;
}

/// The host, which has no memory while it is full.
class FullBackend {
 public:
    using Host = mir::host::Backend<InlineExecutor>;
    static constexpr mir::Space space = mir::Space::host;
    template <class T>
    using Buffer = Host::Buffer<T>;
    template <class T>
    using HostBuffer = Host::HostBuffer<T>;
    using Event = Host::Event;
    using Queue = Host::Queue;

    explicit FullBackend(const int& times_full) : times_full_(&times_full) {}

    [[nodiscard]] Queue queue() const { return Queue(shared_executor()); }
    template <class T>
    [[nodiscard]] Buffer<T> buffer(std::size_t size) const {
        if (*times_full_ > 0)
            throw mir::Error(mir::ErrorCode::out_of_memory, "the machine is full");
        return Buffer<T>(size);
    }
    template <class T>
    [[nodiscard]] HostBuffer<T> host_buffer(std::size_t size) const {
        return HostBuffer<T>(size);
    }

 private:
    const int* times_full_;
};
static_assert(mir::Backend<FullBackend>);

/// Renders on machines of which number 0 is full until it was trimmed so often.
struct Machine {
    explicit Machine(int times_full) : full(times_full) {}

    mir::RenderResult render(const RenderSettings& settings) {
        const auto open = [this](std::uint32_t number) -> mir::BackendMachine<FullBackend> {
            ++opened;
            if (number > 0)
                return {FullBackend(never_full), "host", "a large host",
                        [] { return std::uint64_t{1} << 32; }, [] {}};
            return {FullBackend(full), "host", "a tight host",
                    [] { return std::uint64_t{1} << 30; },
                    [this] {
                        ++trims;
                        --full;
                    }};
        };
        const auto usable = [] { return std::vector<std::uint32_t>{0, 1, 2}; };
        const mir::BackendRenderer<FullBackend> renderer("rcvp", mir::BackendScheduler::rcvp, open,
                                                         usable);
        return renderer.render(scene, settings, nullptr);
    }

    mir::Scene scene = mirtest::glossy_box();
    int full;
    const int never_full = 0;
    int trims = 0;
    int opened = 0;
};

RenderSettings small_picture() {
    RenderSettings s = mirtest::small_settings(24, 16);
    s.tile.reset();
    s.metropolis.bootstrap.min_paths = s.metropolis.bootstrap.max_paths = 4096;
    return s;
}

}  // namespace

TEST_CASE("A renderer over a backend says what rendered") {
    const mir::RenderStatistics s = Machine(0).render(small_picture()).statistics;
    CHECK(s.backend == "host");
    CHECK(s.device == "a tight host");
    CHECK(s.scheduler == "rcvp");
    CHECK(s.acceleration == "bvh");
    CHECK(!s.scene_hash.empty());
    CHECK(s.triangles > 0);
}

TEST_CASE("A renderer over a backend gathers many VPLs by cuts where the sum is not said") {
    RenderSettings s = small_picture();
    s.image = {4, 4};
    s.sampler = mir::SamplerKind::instant_radiosity;
    s.vpls = mir::most_vpls_summed + 100;
    s.picks = 6;
    const mir::RenderStatistics found = Machine(0).render(s).statistics;
    CHECK(found.vpls > mir::most_vpls_summed);
    CHECK(found.contributions == found.luxels * 6);
    s.sum = mir::LightSum::all;
    CHECK(Machine(0).render(s).statistics.contributions == found.luxels * found.vpls);
}

TEST_CASE("A renderer over a backend tries smaller tiles while memory is short, with equal bits") {
    const mir::RenderResult wanted = Machine(0).render(small_picture());
    Machine tight(2);  // tiles of 1024, 512, 256
    const mir::RenderResult found = tight.render(small_picture());
    CHECK(tight.trims == 2);
    CHECK(mirtest::same_bits(found.beauty, wanted.beauty));
    Machine hopeless(5);  // down to 64
    try {
        static_cast<void>(hopeless.render(small_picture()));
        FAIL("the machine is full");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::out_of_memory);
    }
    CHECK(hopeless.trims == 4);
}

TEST_CASE("Machines that share a picture give the bytes of one, also where memory is short") {
    RenderSettings s = small_picture();
    const mir::RenderResult wanted = Machine(0).render(s);
    SECTION("by number") {
        s.devices.numbers = {2, 0};
        Machine two(1);
        const mir::RenderResult found = two.render(s);
        CHECK(found.statistics.device == "a large host, a tight host");
        CHECK(two.opened == 2);
        CHECK(two.trims == 1);
        CHECK(mirtest::same_bits(found.beauty, wanted.beauty));
    }
    SECTION("all") {
        s.devices.all = true;
        Machine all(0);
        const mir::RenderResult found = all.render(s);
        CHECK(all.opened == 3);
        CHECK(found.statistics.acceleration == wanted.statistics.acceleration);
        CHECK(mirtest::same_bits(found.beauty, wanted.beauty));
    }
    SECTION("one that is not the first") {
        s.devices.numbers = {1};
        Machine one(9);
        CHECK(mirtest::same_bits(one.render(s).beauty, wanted.beauty));
        CHECK(one.trims == 0);
    }
}

TEST_CASE("The processor refuses GPUs by number, and takes all where there are none") {
    RenderSettings s = small_picture();
    const mir::Scene scene = mirtest::glossy_box();
    s.devices.all = true;
    CHECK_NOTHROW(mirtest::render(scene, s));
    s.devices = {false, {0}};
    try {
        static_cast<void>(mirtest::render(scene, s));
        FAIL("nothing was thrown");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::unsupported);
        CHECK(std::string(e.what()).find("--devices") != std::string::npos);
    }
}

TEST_CASE("Luxels gather from discs on the backend, with the bits of the host") {
    RenderSettings s = small_picture();
    s.integrator = mir::Integrator::micro;
    s.micro.surfels = 64;
    s.micro.gather.rays = 16;
    s.micro.luxels = GENERATE(mir::MicroGather::rays, mir::MicroGather::buffers);
    Machine machine(0);
    const mir::RenderResult there = machine.render(s);
    s.acceleration = mir::Acceleration::kd_tree;
    s.backend = mir::BackendKind::cpu;
    const mir::RenderResult here = mirtest::render(machine.scene, s);
    CHECK(there.statistics.acceleration == "kdtree");
    CHECK(there.statistics.indirect_luminance > 0.0);
    CHECK(mirtest::same_bits(there.beauty, here.beauty));
}

TEST_CASE("Paths of a renderer over a backend are traced on the host") {
    RenderSettings s = small_picture();
    s.integrator = mir::Integrator::path;
    s.path.samples = 1;
    Machine machine(9);  // nothing is asked of its memory
    const mir::RenderResult there = machine.render(s);
    s.acceleration = mir::Acceleration::kd_tree;
    s.backend = mir::BackendKind::cpu;
    CHECK(mirtest::same_bits(there.beauty, mirtest::render(machine.scene, s).beauty));
}

TEST_CASE("A renderer over a backend refuses what its frames lack") {
    RenderSettings s = small_picture();
    s.sum = mir::LightSum::cuts;
    s.pick_error_layer = true;
    try {
        static_cast<void>(Machine(0).render(s));
        FAIL("nothing was thrown");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::unsupported);
        CHECK(std::string(e.what()) == mir::reason_without(mir::FrameFeature::pick_error));
    }
}
