// SPDX-License-Identifier: MIT
#include "conformance/brute_force.hpp"
#include "conformance/scheduler_suite.hpp"
#include "mir/fill_visibility.hpp"
#include "mir/host/backend.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/reshade.hpp"
#include "mir/sched/reconstruct.hpp"
#include "mir/sched/reconstruct_visibility_parallel.hpp"
#include "mir/sched/shading_only.hpp"
#include "support/catch.hpp"
#include "support/lazy_backend.hpp"

// OS, RC and RCVP over the host, and over a backend that does nothing before it has to.

namespace {

template <mir::Bsdf B>
using Stage = mirtest::Stage<B, mirtest::BruteForceScene>;

/// Calls check(scheduler) for each of the three schedulers over `backend`.
template <mir::Backend B, mir::Executor E, class Check>
void with_each(const B& backend, E& executor, mir::Monitor* monitor, const Check& check) {
    check(mir::sched::ShadingOnly{backend, executor, monitor});
    check(mir::sched::Reconstruct{backend, monitor});
    check(mir::sched::ReconstructVisibilityParallel{backend, monitor});
}

}  // namespace

TEMPLATE_TEST_CASE("OS, RC and RCVP on the host keep the axioms of Scheduler", "", mir::Lambert,
                   mir::CookTorrance) {
    const Stage<TestType> stage({100, 70}, {48, 32}, 37);
    mir::InlineExecutor one;
    mir::TbbExecutor many(3);
    with_each(mir::host::Backend(one), one, nullptr,
              [&](const auto& scheduler) { mirtest::scheduler_suite(scheduler, stage); });
    with_each(mir::host::Backend(many), many, nullptr,
              [&](const auto& scheduler) { mirtest::scheduler_suite(scheduler, stage); });
}

TEST_CASE("OS, RC and RCVP wait for all that they need, however late it is done") {
    const Stage<mir::CookTorrance> stage({100, 70}, {16, 32}, 7);
    const std::uint32_t eager_queues = GENERATE(0u, 1u, 2u, 3u);
    const mir::VplShading<mir::CookTorrance> shading{2.0f};
    const auto wanted = mirtest::oracle(stage, shading);
    mir::InlineExecutor executor;
    mirtest::PutOff work(eager_queues);
    const auto check = [&](const auto& scheduler) {
        const auto found =
            mir::reconstruct(scheduler, stage.gbuffer(), stage.vpls(), stage.visibility(), shading);
        CHECK(mirtest::pixels_that_differ(found, wanted) == 0);
    };
    // Queues are numbered as they are made; each scheduler has its own schedule.
    const mirtest::LazyBackend backend(work);
    SECTION("OS") { check(mir::sched::ShadingOnly{backend, executor}); }
    SECTION("RC") { check(mir::sched::Reconstruct{backend}); }
    SECTION("RCVP") { check(mir::sched::ReconstructVisibilityParallel{backend}); }
}

TEST_CASE("OS, RC and RCVP reshade from known visibility") {
    const Stage<mir::Lambert> stage({70, 50}, {48, 32}, 23);
    mir::InlineExecutor executor;
    mir::VisibilityMatrix matrix(stage.gbuffer().tiles(), stage.vpls().size());
    fill_visibility(matrix, stage.gbuffer(), stage.vpls(), stage.visibility(), executor);
    const mir::VplShading<mir::Lambert> shading{};
    const auto wanted = mirtest::oracle(stage, shading);
    with_each(mir::host::Backend(executor), executor, nullptr, [&](const auto& scheduler) {
        const auto found = mir::reshade(scheduler, stage.gbuffer(), stage.vpls(), matrix, shading);
        CHECK(mirtest::pixels_that_differ(found, wanted) == 0);
    });
}

TEST_CASE("OS, RC and RCVP count contributions and stop when they are told to") {
    const Stage<mir::Lambert> stage({20, 20}, {16, 16}, 3);
    mir::InlineExecutor executor;
    mir::Monitor monitor;
    with_each(mir::host::Backend(executor), executor, &monitor, [&](const auto& scheduler) {
        const auto run = [&] {
            return mir::reconstruct(scheduler, stage.gbuffer(), stage.vpls(), stage.visibility(),
                                    mir::VplShading<mir::Lambert>{});
        };
        monitor.contributions = 0;
        monitor.cancelled = false;
        static_cast<void>(run());
        CHECK(monitor.contributions == 1200);
        monitor.cancelled = true;
        try {
            static_cast<void>(run());
            FAIL("a cancelled render went on");
        } catch (const mir::Error& e) {
            CHECK(e.code() == mir::ErrorCode::cancelled);
        }
    });
}

TEST_CASE("OS, RC and RCVP may have one tile that is larger than the image") {
    const Stage<mir::Lambert> stage({20, 13}, {512, 256}, 3);
    const mir::VplShading<mir::Lambert> shading{};
    const auto wanted = mirtest::oracle(stage, shading);
    mir::InlineExecutor executor;
    with_each(mir::host::Backend(executor), executor, nullptr, [&](const auto& scheduler) {
        const auto found =
            mir::reconstruct(scheduler, stage.gbuffer(), stage.vpls(), stage.visibility(), shading);
        CHECK(mirtest::pixels_that_differ(found, wanted) == 0);
    });
}
