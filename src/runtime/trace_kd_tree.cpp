// SPDX-License-Identifier: MIT
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "runtime/traced_scene.hpp"
#include "runtime/traced_scenes.hpp"

namespace mir {

TracedScenePtr trace_by_kd_tree(const WorldGeometry& geometry, AnyExecutor& executor) {
    return std::make_unique<TracedScene>(std::make_unique<const KdTreeScene>(geometry, executor));
}

KdTree tree_for_backends(const WorldGeometry& geometry, AnyExecutor& executor) {
    return {geometry, KdTreeOptions::for_gpu(), executor};
}

}  // namespace mir
