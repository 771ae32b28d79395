// SPDX-License-Identifier: MIT
#include "runtime/host_schedulers.hpp"

#include "conformance/scheduler_suite.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "support/catch.hpp"

TEST_CASE("A host scheduler that is chosen by name keeps the axioms of Scheduler") {
    const mirtest::Stage<mir::Lambert, mir::KdTreeScene> stage({100, 70}, {48, 32}, 37);
    mir::InlineExecutor executor;
    for (const auto& [name, kind] : mir::host_schedulers) {
        CAPTURE(name);
        mir::with_host_scheduler(kind, executor, nullptr, [&](const auto& scheduler) {
            mirtest::scheduler_suite(scheduler, stage);
        });
    }
}
