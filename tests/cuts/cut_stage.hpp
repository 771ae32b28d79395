// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/stage.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/reconstruct.hpp"
#include "mir/reconstruct_cuts.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/vpl_shading.hpp"

#include <cstdint>

namespace mirtest {

/// Luxels, VPLs and rays of a soup of triangles.
template <mir::Bsdf B>
using KdStage = Stage<B, mir::KdTreeScene>;

/// Shading under the bound of these tests.
template <mir::Bsdf B>
mir::VplShading<B> bounded() {
    mir::VplShading<B> shading;
    shading.bound = 20.0f;
    return shading;
}

/// Over all VPLs of a stage.
template <class Stage>
mir::VplTree tree_of(const Stage& stage) {
    mir::InlineExecutor executor;
    return {stage.vpls(), executor};
}

/// One picture by cuts; `variance` as of reconstruct_cuts().
template <class B, class Policy>
mir::Image<mir::Rgb> gather(const KdStage<B>& stage, const mir::VplTree& tree, const Policy& policy,
                            std::uint64_t seed, mir::Image<float>* variance = nullptr) {
    mir::InlineExecutor executor;
    return reconstruct_cuts(stage.gbuffer(), tree, stage.visibility(), bounded<B>(), policy, {seed},
                            executor, nullptr, mir::best_instruction_set(), variance);
}

/// What pictures by cuts have as their mean.
template <class B>
mir::Image<mir::Rgb> full_sum(const KdStage<B>& stage, const mir::VplTree& tree) {
    mir::InlineExecutor executor;
    return reconstruct(mir::sched::CpuBlocks{executor}, stage.gbuffer(), tree.leaves(),
                       stage.visibility(), bounded<B>());
}

}  // namespace mirtest
