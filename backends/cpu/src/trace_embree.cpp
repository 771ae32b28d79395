// SPDX-License-Identifier: MIT
#include "mir/cpu/embree_scene.hpp"
#include "runtime/traced_scene.hpp"
#include "runtime/traced_scenes.hpp"

namespace mir {
namespace {

TracedScenePtr trace_by_embree(const WorldGeometry& geometry, Monitor* monitor) {
    return std::make_unique<TracedScene>(
        std::make_unique<const cpu::EmbreeScene>(geometry, cpu::EmbreeScene::any_bytes, monitor));
}

}  // namespace

const EmbreeTracing* embree_tracing() {
    static const EmbreeTracing embree{"Embree " RTC_VERSION_STRING, trace_by_embree};
    return &embree;
}

}  // namespace mir
