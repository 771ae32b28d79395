// SPDX-License-Identifier: MIT
#pragma once

#include "mir/film/guides.hpp"
#include "mir/runtime/image_bands.hpp"
#include "mir/scene/light_table.hpp"

namespace mir {

/// One render under way, whatever makes its picture: the scene in the form that the stages want,
/// and the result as it grows. What was passed in must outlive it. `Engine` offers ray_caster() and
/// visibility().
template <Bsdf B, class Engine, Executor E>
struct RenderJob {
    using Context = RenderContext<B, Engine, E>;  ///< what the stages are given

    /// `monitor` may be null.
    RenderJob(const Scene& scene, const RenderSettings& render_settings,
              const WorldGeometry& world_geometry, const Engine& ray_engine, E& loops,
              Monitor* progress, StageClock& stage_clock)
        : settings(render_settings),
          geometry(world_geometry),
          engine(ray_engine),
          executor(loops),
          monitor(progress),
          clock(stage_clock),
          lights([&] {
              const auto stage = clock.measure(&StageSeconds::geometry);
              return LightTable(scene, geometry);
          }()),
          surfaces(scene),
          rays{scene.cameras[settings.camera],
               luxel_grid(settings.image, settings.luxels_per_pixel, settings.limits),
               settings.seed},
          result{{}, {}, {}, {}, {}, Guides::unwritten(settings.image), {}, {}, {}} {}

    /// Width / height of the image.
    [[nodiscard]] float aspect() const { return settings.aspect(); }

    /// For the stages; a view.
    [[nodiscard]] Context context() {
        return {settings, geometry, surfaces, rays, engine, executor, monitor, clock};
    }

    /// Tells the monitor that band `i` of `bands` begins.
    void begin_band(std::uint32_t i, std::uint32_t bands) const {
        if (monitor == nullptr) return;
        monitor->planned_bands = bands;
        monitor->bands = i + 1;
    }

    /// Adds what a denoiser wants to know of the luxels of a band to the result.
    void add_guides_of(const ImageBand<B>& band) {
        const auto stage = clock.measure(&StageSeconds::guides);
        add_guides<B>(result.guides, band.gbuffer, band.first_row, rays.grid, rays.camera,
                      executor);
    }

    /// The finished result; leaves the job without it.
    [[nodiscard]] RenderResult take_result() {
        result.statistics.seconds = clock.seconds();
        return std::move(result);
    }

    const RenderSettings& settings;  ///< validated
    const WorldGeometry& geometry;   ///< of the scene
    const Engine& engine;            ///< finds where rays end
    E& executor;                     ///< runs the loops of every stage
    Monitor* monitor;                ///< may be null
    StageClock& clock;               ///< to which stages tell their time
    LightTable lights;               ///< of the scene
    SurfaceTable<B> surfaces;        ///< of the scene's materials
    CameraRays rays;                 ///< of the whole image
    RenderResult result;             ///< as far as it has come; take_result() takes it away
};

}  // namespace mir
