// SPDX-License-Identifier: MIT
#include "mir/cpu/embree_scene.hpp"
#include "runtime/traced_scene.hpp"
#include "runtime/traced_scenes.hpp"

namespace mir {
namespace {

TracedScenePtr trace_by_embree(const WorldGeometry& geometry) {
    return std::make_unique<TracedScene>(std::make_unique<const cpu::EmbreeScene>(geometry));
}

}  // namespace

const EmbreeTracing* embree_tracing() {
    static const EmbreeTracing embree{"Embree " RTC_VERSION_STRING, trace_by_embree};
    return &embree;
}

}  // namespace mir
