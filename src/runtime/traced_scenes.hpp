// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_tree.hpp"
#include "mir/core/monitor.hpp"
#include "mir/runtime/any_executor.hpp"
#include "mir/scene/world_geometry.hpp"

#include <memory>
#include <string>

namespace mir {

class TracedScene;

/// What the host traces through; never null. The geometry must outlive it.
using TracedScenePtr = std::unique_ptr<const TracedScene>;

/// Builds KdTreeScene.
/// @throws Error what KdTree throws.
[[nodiscard]] TracedScenePtr trace_by_kd_tree(const WorldGeometry& geometry, AnyExecutor& executor);
/// A kd-tree for kernels of GPUs (KdTreeOptions::for_gpu()).
/// @throws Error what KdTree throws.
[[nodiscard]] KdTree tree_for_backends(const WorldGeometry& geometry, AnyExecutor& executor);
/// Builds ShaftScene.
/// @throws Error what build_wide_bvh() throws.
[[nodiscard]] TracedScenePtr trace_by_shafts(const WorldGeometry& geometry, AnyExecutor& executor);

/// Embree, where the build has it.
struct EmbreeTracing {
    std::string version;  ///< "Embree 3.13.5" or the like
    /// Builds cpu::EmbreeScene, which the monitor stops unless it is null.
    TracedScenePtr (*trace)(const WorldGeometry&, Monitor*);
};
/// Null in a build without.
[[nodiscard]] const EmbreeTracing* embree_tracing();

}  // namespace mir
