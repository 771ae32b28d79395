// SPDX-License-Identifier: MIT
#include "conformance/backend_suite.hpp"
#include "conformance/brute_force.hpp"
#include "conformance/scheduler_suite.hpp"
#include "mir/host/backend.hpp"
#include "mir/sched/reconstruct.hpp"
#include "mir/sched/reconstruct_visibility_parallel.hpp"
#include "mir/sched/shading_only.hpp"
#include "paper/tracing_backend.hpp"
#include "support/catch.hpp"
#include "support/lazy_backend.hpp"

namespace {

using Host = mir::host::Backend<mir::InlineExecutor>;
using Traced = mirpaper::TracingBackend<Host>;
using mirpaper::Work;

static_assert(mir::Backend<Traced>);

double seconds_of(const mirpaper::StageSeconds& s, Work w) {
    return s.of[static_cast<std::size_t>(w)];
}

/// A stage, and the image of one scheduler on it with a note of what happened.
struct Experiment {
    mirtest::Stage<mir::CookTorrance, mirtest::BruteForceScene> stage{{100, 70}, {48, 32}, 37};
    mir::VplShading<mir::CookTorrance> shading{2.0f};
    mir::InlineExecutor executor;
    mirpaper::Trace<Host> trace{mirpaper::Detail::all};
    Traced backend{Host(executor), trace};

    [[nodiscard]] std::size_t wrong_pixels(const auto& scheduler) {
        const auto found =
            mir::reconstruct(scheduler, stage.gbuffer(), stage.vpls(), stage.visibility(), shading);
        return mirtest::pixels_that_differ(found, mirtest::oracle(stage, shading));
    }
};

}  // namespace

TEST_CASE("Schedulers make the same image on a traced backend, and the trace knows their work") {
    Experiment e;
    SECTION("RC has one kernel") {
        CHECK(e.wrong_pixels(mir::sched::Reconstruct{e.backend}) == 0);
        const auto s = e.trace.stages();
        CHECK(seconds_of(s, Work::fused) > 0.0);
        CHECK(seconds_of(s, Work::visibility) + seconds_of(s, Work::shading) == 0.0);
        CHECK(seconds_of(s, Work::upload) > 0.0);
        CHECK(seconds_of(s, Work::download) > 0.0);
    }
    SECTION("RCVP has two") {
        CHECK(e.wrong_pixels(mir::sched::ReconstructVisibilityParallel{e.backend}) == 0);
        const auto s = e.trace.stages();
        CHECK(seconds_of(s, Work::fused) == 0.0);
        CHECK(seconds_of(s, Work::visibility) > 0.0);
        CHECK(seconds_of(s, Work::shading) > 0.0);
    }
    SECTION("OS shades only") {
        CHECK(e.wrong_pixels(mir::sched::ShadingOnly{e.backend, e.executor}) == 0);
        const auto s = e.trace.stages();
        CHECK(seconds_of(s, Work::fused) + seconds_of(s, Work::visibility) == 0.0);
        CHECK(seconds_of(s, Work::shading) > 0.0);
    }
    // One after the other on the host: nothing overlaps, and nothing is longer than the whole.
    const auto s = e.trace.stages();
    CHECK(seconds_of(s, Work::other) == 0.0);
    CHECK(s.overlap() == mirtest::Approx(0.0).margin(1e-9));
    CHECK(s.busy <= s.span);
    CHECK(s.span <= e.trace.seconds());  // which is noted outside of the rest
}

TEST_CASE("A trace of the ends alone measures the same run with fewer marks") {
    mir::InlineExecutor executor;
    mirpaper::Trace<Host> trace(mirpaper::Detail::ends);
    const Traced backend(Host(executor), trace);
    auto queue = backend.queue();
    auto buffer = backend.buffer<std::uint32_t>(4);
    std::vector<std::uint32_t> words(4, 7);
    CHECK(trace.seconds() == 0.0);
    queue.upload(std::span<const std::uint32_t>(words), buffer);
    CHECK(trace.seconds() == 0.0);  // nothing has come home yet
    queue.download(buffer, std::span<std::uint32_t>(words));
    const double once = trace.seconds();
    CHECK(once > 0.0);
    queue.download(buffer, std::span<std::uint32_t>(words));
    CHECK(trace.seconds() > once);
    CHECK(trace.stages().sum() == 0.0);
}

TEST_CASE("A traced backend keeps the axioms of Backend") {
    // One that does nothing before it has to notices whatever is not passed on.
    mirtest::PutOff work(0);
    mirpaper::Trace<mirtest::LazyBackend> trace(mirpaper::Detail::all);
    const mirpaper::TracingBackend traced(mirtest::LazyBackend(work), trace);
    const auto findings = mirtest::examine_backend(traced);
    CHECK(findings.size() > 30);
    for (const auto& [experiment, wrong] : findings) {
        INFO(experiment);
        CHECK(wrong == 0);
    }
}
