// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/passes.hpp"
#include "conformance/stage.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "mir/validation/scheduler.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <limits>
#include <vector>

// The axioms of Scheduler. Bits are compared, so the tests are built with -ffp-contract=off.

namespace mirtest {

/// What the oracle makes of the same inputs, on one thread.
template <class S, class F>
mir::Image<mir::Rgb> oracle(const S& stage, const F& shading) {
    mir::InlineExecutor executor;
    return mir::reconstruct(mir::sched::Cpu{executor}, stage.gbuffer(), stage.vpls(),
                            stage.visibility(), shading);
}

/// All axioms, for one stage and a shading of it, and the image of another shading.
template <mir::Bsdf B, class Scheduler, class Engine>
void scheduler_suite(const Scheduler& scheduler, const Stage<B, Engine>& stage) {
    passes(mir::validation::check_scheduler(scheduler, stage.gbuffer(), stage.vpls(),
                                            stage.visibility(), mir::VplShading<B>{2.0f}));
    const mir::RemovedByBound<B> removed{2.0f};
    const mir::Image<mir::Rgb> found =
        mir::reconstruct(scheduler, stage.gbuffer(), stage.vpls(), stage.visibility(), removed);
    CHECK(pixels_that_differ(found, oracle(stage, removed)) == 0);
}

}  // namespace mirtest
