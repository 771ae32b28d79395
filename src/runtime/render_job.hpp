// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/runtime/any_executor.hpp"
#include "mir/runtime/cancellable_executor.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"
#include "mir/runtime/stage_clock.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/scene/world_geometry.hpp"
#include "runtime/blacken_rows.hpp"
#include "runtime/compiled_bsdfs.hpp"

namespace mir {

class PictureShare;

/// A scene whose triangles lie where they belong, and what works on it. A view.
struct PlacedScene {
    const Scene& scene;             ///< checked
    const WorldGeometry& geometry;  ///< of the scene
    AnyExecutor threads;            ///< cannot be cancelled
    Monitor* monitor;               ///< may be null
    StageClock& clock;              ///< to which stages tell their time
};

/// One render under way, whatever makes its picture. The scene in the form that the stages want,
/// and the result as it grows. What was passed in must outlive it.
struct RenderJob {
    /// `wanted` must be valid.
    RenderJob(const PlacedScene& placed, const RenderSettings& wanted)
        : scene(placed.scene),
          settings(wanted),
          geometry(placed.geometry),
          threads(placed.threads),
          monitor(placed.monitor),
          clock(placed.clock),
          lights([&] {
              const auto stage = clock.measure(&StageSeconds::geometry);
              return LightTable(scene, geometry);
          }()),
          surfaces(surfaces_of(scene)),
          rays{scene.cameras[settings.camera],
               luxel_grid(settings.image, settings.luxels_per_pixel, settings.limits,
                          {settings.only_luxel.x, settings.only_luxel.y}),
               settings.seed},
          result{{}, {}, {}, {}, {}, Guides::unwritten(settings.image), {}, {}, {}} {}
    RenderJob(const RenderJob&) = delete;
    RenderJob& operator=(const RenderJob&) = delete;
    ~RenderJob() = default;

    /// Width / height of the image.
    [[nodiscard]] float aspect() const { return settings.aspect(); }

    /// Calls use(surfaces) with the SurfaceTable of the scene's model, and returns what it returns.
    template <class Use>
    [[nodiscard]] auto with_surfaces(const Use& use) const {
        return std::visit(use, surfaces);
    }

    /// Tells the monitor that a loop over so many bands begins.
    void begin_bands(std::uint32_t bands) const {
        if (monitor == nullptr) return;
        monitor->planned_bands = bands;
        monitor->bands = 0;
    }
    /// Tells the monitor that a band of the loop begins.
    void begin_band() const {
        if (monitor != nullptr) ++monitor->bands;
    }

    /// The finished result; leaves the job without it.
    [[nodiscard]] RenderResult take_result() {
        result.statistics.seconds = clock.seconds();
        blacken_other_rows(settings.rows, result);
        return std::move(result);
    }

    const Scene& scene;              ///< checked
    const RenderSettings& settings;  ///< validated
    const WorldGeometry& geometry;   ///< of the scene
    AnyExecutor threads;             ///< for loops that nothing may stop
    Monitor* monitor;                ///< may be null
    StageClock& clock;               ///< to which stages tell their time
    LightTable lights;               ///< of the scene
    AnySurfaces surfaces;            ///< of the scene's materials
    CameraRays rays;                 ///< of the whole image
    PictureShare* share = nullptr;   ///< of processes that make it together; null: there is one
    std::vector<Image<Rgb>> layers;  ///< pixels that films of devices have brought home
    RenderResult result;             ///< as far as it has come; take_result() takes it away

 private:
    CancellableExecutor<AnyExecutor> loops_{threads, monitor};

 public:
    AnyExecutor executor{loops_};  ///< runs the loops of every stage, which the monitor can stop
};

}  // namespace mir
