// SPDX-License-Identifier: MIT
#include "runtime/checked_render.hpp"

#include "mir/runtime/cancellable_executor.hpp"
#include "mir/runtime/check_scene.hpp"
#include "mir/runtime/check_world.hpp"
#include "mir/scene/scene_hash.hpp"

#include <utility>

namespace mir {
namespace {

std::vector<std::string> checked(const Scene& scene, const RenderSettings& settings) {
    settings.validate();
    return check_scene(scene, settings);
}

NearScene brought_near(const Scene& scene, StageClock& clock) {
    const auto stage = clock.measure(&StageSeconds::geometry);
    return NearScene(scene);
}

WorldGeometry placed_triangles(const Scene& scene, const RenderSettings& settings,
                               TbbExecutor& threads, Monitor* monitor, StageClock& clock) {
    const auto stage = clock.measure(&StageSeconds::geometry);
    CancellableExecutor loops(threads, monitor);
    AnyExecutor executor(loops);
    return {scene, settings.limits, executor};
}

}  // namespace

CheckedRender::CheckedRender(const Scene& scene, const RenderSettings& settings, Monitor* monitor,
                             std::launch fingerprint, const PictureShare* share)
    : warnings_(checked(scene, settings)),
      clock_(monitor),
      fingerprint_(std::async(fingerprint, [&scene] { return SceneHash(scene).hex(); })),
      near_(brought_near(scene, clock_)),
      threads_(settings.threads, share == nullptr ? 1 : 2),
      geometry_(placed_triangles(near_.scene(), settings, threads_, monitor, clock_)),
      placed_{near_.scene(), geometry_, AnyExecutor(threads_), monitor, clock_} {
    warnings_.insert(warnings_.end(), near_.remarks().begin(), near_.remarks().end());
    check_world(near_.scene(), settings.camera, geometry_);
}

RenderResult CheckedRender::complete(RenderResult result) {
    RenderStatistics& s = result.statistics;
    s.triangles = geometry_.triangles().size();
    s.dropped_triangles = geometry_.dropped_triangles();
    s.coinciding_triangles = geometry_.coinciding_triangles();
    s.origin = near_.scene().origin;
    {
        const auto stage = clock_.measure(&StageSeconds::hash);
        s.scene_hash = fingerprint_.get();
    }
    s.seconds = clock_.seconds();
    add_result_warnings(result, warnings_);
    result.warnings = std::move(warnings_);
    return result;
}

}  // namespace mir
