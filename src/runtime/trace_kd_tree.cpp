// SPDX-License-Identifier: MIT
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "runtime/traced_scene.hpp"
#include "runtime/traced_scenes.hpp"

mir::TracedScenePtr mir::trace_by_kd_tree(const WorldGeometry& geometry, AnyExecutor& executor) {
    return std::make_unique<TracedSceneOf<KdTreeScene>>(
        std::make_unique<KdTreeScene>(geometry, executor));
}
