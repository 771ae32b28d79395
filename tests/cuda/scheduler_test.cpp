// SPDX-License-Identifier: MIT
#include "conformance/scheduler_suite.hpp"
#include "cuda/reconstruct.hpp"
#include "mir/fill_visibility.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "support/catch.hpp"

#include <thread>

// OS, RC and RCVP over the GPU against sched::Cpu on the host, in every bit.

namespace {

using mir::cuda::Backend;
template <mir::Bsdf B>
using Stage = mirtest::Stage<B, mirtest::BruteForceRows>;
using Lambert = mir::VplShading<mir::Lambert>;

Backend first_gpu() { return Backend(mir::cuda::select_device(0)); }

/// Images of all algorithms, in turn.
template <class S, class F>
void check_all(const Backend& backend, const S& stage, const F& shading) {
    const auto wanted = mirtest::oracle(stage, shading);
    std::size_t lit = 0;
    for (const mir::Rgb& c : wanted.pixels()) lit += mir::is_black(c) ? 0 : 1;
    CHECK(lit > 100);
    for (const mirtest::Algorithm a : mirtest::algorithms) {
        CAPTURE(static_cast<int>(a));
        const auto found = mirtest::reconstruct_on(backend, a, stage.gbuffer(), stage.vpls(),
                                                   stage.visibility(), shading);
        CHECK(mirtest::pixels_that_differ(found, wanted) == 0);
    }
}

}  // namespace

TEMPLATE_TEST_CASE("OS, RC and RCVP on the GPU give the host's image in every bit", "",
                   mir::Lambert, mir::CookTorrance) {
    const Backend backend = first_gpu();
    const Stage<TestType> ragged({100, 70}, {48, 32}, 37);
    check_all(backend, ragged, mir::VplShading<TestType>{2.0f});
    check_all(backend, ragged, mir::VplShading<TestType>{});
}

TEST_CASE("What a bound removes is the host's in every bit on the GPU") {
    const Stage<mir::CookTorrance> stage({100, 70}, {48, 32}, 37);
    check_all(first_gpu(), stage, mir::RemovedByBound<mir::CookTorrance>{0.2f});
}

TEST_CASE("Tiles of any size give the host's image on the GPU") {
    const mir::Extent tile = GENERATE(mir::Extent{16, 16}, mir::Extent{7, 300},
                                      mir::Extent{512, 256}, mir::Extent{100, 1});
    const Stage<mir::Lambert> stage({100, 70}, tile, 33);
    check_all(first_gpu(), stage, Lambert{});
}

TEST_CASE("No VPLs and a single one give the host's image on the GPU") {
    const Backend backend = first_gpu();
    for (std::uint32_t vpls : {0u, 1u}) {
        const Stage<mir::Lambert> stage({40, 30}, {48, 16}, vpls);
        const auto wanted = mirtest::oracle(stage, Lambert{});
        for (const mirtest::Algorithm a : mirtest::algorithms) {
            const auto found = mirtest::reconstruct_on(backend, a, stage.gbuffer(), stage.vpls(),
                                                       stage.visibility(), Lambert{});
            CHECK(mirtest::pixels_that_differ(found, wanted) == 0);
        }
    }
}

TEST_CASE("Known visibility is reshaded on the GPU to the host's image") {
    const Stage<mir::Lambert> stage({70, 50}, {48, 32}, 23);
    mir::InlineExecutor executor;
    mir::VisibilityMatrix matrix(stage.gbuffer().tiles(), stage.vpls().size());
    fill_visibility(matrix, stage.gbuffer(), stage.vpls(), stage.visibility(), executor);
    const auto wanted = mirtest::oracle(stage, Lambert{});
    for (const mirtest::Algorithm a : mirtest::algorithms) {
        CAPTURE(static_cast<int>(a));
        const auto found =
            mirtest::reshade_on(first_gpu(), a, stage.gbuffer(), stage.vpls(), matrix, Lambert{});
        CHECK(mirtest::pixels_that_differ(found, wanted) == 0);
    }
}

TEST_CASE("Luxels in pinned memory give the same image") {
    const Stage<mir::Lambert> stage({100, 70}, {48, 32}, 37);
    const Backend backend = first_gpu();
    mir::BlockedGBuffer<mir::Lambert::Params, mir::cuda::PinnedAllocator<std::uint32_t>> pinned(
        {100, 70}, {48, 32}, backend.pinned<std::uint32_t>());
    for (mir::TileIndex t = 0; t < stage.gbuffer().tiles().size(); ++t) {
        const auto luxels = stage.gbuffer().view(t);
        for (mir::LuxelIndex i = 0; i < luxels.size(); ++i)
            pinned.store(t, i, luxels.hit(i), luxels.surface(i));
    }
    const auto found = mirtest::reconstruct_pinned_on(backend, pinned, stage.vpls(),
                                                      stage.visibility(), Lambert{});
    CHECK(mirtest::pixels_that_differ(found, mirtest::oracle(stage, Lambert{})) == 0);
}

TEST_CASE("The caller's stream and other GPUs give the host's image") {
    const Stage<mir::Lambert> stage({100, 70}, {48, 32}, 37);
    for (const auto& device : mir::cuda::devices()) {
        const Backend backend(device);
        check_all(backend, stage, Lambert{});
        check_all(backend.on(cudaStreamLegacy), stage, Lambert{});
    }
}

TEST_CASE("Two backends in two threads make their images at the same time") {
    const Stage<mir::Lambert> stage({100, 70}, {16, 16}, 37);
    const auto wanted = mirtest::oracle(stage, Lambert{});
    const auto last = static_cast<int>(mir::cuda::devices().size()) - 1;
    std::size_t wrong[2] = {};
    const auto make_images = [&](int device, std::size_t& differences) {
        const Backend backend(mir::cuda::select_device(device));
        for (int repeat = 0; repeat < 10; ++repeat)
            for (const mirtest::Algorithm a : mirtest::algorithms)
                differences += mirtest::pixels_that_differ(
                    mirtest::reconstruct_on(backend, a, stage.gbuffer(), stage.vpls(),
                                            stage.visibility(), Lambert{}),
                    wanted);
    };
    std::thread other([&] { make_images(last, wrong[1]); });
    make_images(0, wrong[0]);
    other.join();
    CHECK(wrong[0] == 0);
    CHECK(wrong[1] == 0);
}
