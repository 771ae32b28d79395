// SPDX-License-Identifier: MIT
#include "mir/host/shaft_scene.hpp"
#include "runtime/traced_scene.hpp"
#include "runtime/traced_scenes.hpp"

mir::TracedScenePtr mir::trace_by_shafts(const WorldGeometry& geometry, AnyExecutor& executor) {
    return std::make_unique<TracedScene>(std::make_unique<const ShaftScene>(geometry, executor));
}
