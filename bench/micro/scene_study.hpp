// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cpu/embree_scene.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/micro/gather_light.hpp"
#include "mir/micro/make_surfels.hpp"
#include "mir/micro/surfel_albedo.hpp"
#include "mir/micro/surfel_bounces.hpp"
#include "mir/micro/surfel_direct_light.hpp"
#include "mir/micro/surfel_tree_build.hpp"
#include "mir/reference/trace_reference.hpp"
#include "tools/mir/load_scene.hpp"

#include <cmath>
#include <string>

// What programs that measure micro-rendering share: a scene with Lambertian surfaces, small images
// of its bounces by path tracing and from discs, and how far they are apart.

namespace mirstudy {

inline constexpr std::uint32_t side = 48;  ///< luxels of an image, in each direction
inline constexpr std::uint8_t last_bounce = 4;

struct SceneStudy {
    explicit SceneStudy(const std::string& name) : scene(mirtool::load_scene(name).scene) {
        fill_gbuffer<mir::Lambert>(gbuffer, 0, rays, engine.ray_caster(), surfaces, executor);
    }

    mir::Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<mir::Lambert> surfaces{scene};
    mir::cpu::EmbreeScene engine{geometry};
    mir::TbbExecutor executor;
    mir::CameraRays rays{scene.cameras.front(), {{side, side}}, 7};
    mir::BlockedGBuffer<mir::Lambert::Params> gbuffer{{side, side}, {side, side}};
};

/// D_0 to D_4 by path tracing, one estimate after the other of `samples` paths per luxel.
inline mir::ReferenceImage reference(SceneStudy& s, std::uint32_t samples) {
    const mir::PathTracer<mir::Lambert, mir::cpu::EmbreeRayCaster, mir::cpu::EmbreeVisibility>
        tracer({s.geometry, s.lights, s.surfaces, s.engine.ray_caster(), s.engine.visibility()},
               {.light = mir::LightSearch::lamps, .max_bounce = last_bounce});
    mir::ReferenceOptions wanted;
    wanted.samples = samples;
    wanted.replicates = 1;
    wanted.last_bounce = last_bounce;
    return trace_reference(tracer, s.rays, wanted, s.executor);
}

/// About `surfels` discs, as many as `mir render --surfels` makes.
inline mir::SurfelTree make_tree(SceneStudy& s, std::uint32_t surfels, mir::DiscExtent extent,
                                 const mir::SurfelTreeOptions& options = {}) {
    const auto area = static_cast<float>(surface_area(s.geometry) / surfels);
    return {make_surfels(s.geometry, {area, extent}, {}, s.executor),
            mir::SurfelAlbedo<mir::Lambert>(s.surfaces, s.geometry), options, s.executor};
}

/// How discs are lit.
struct LightPlan {
    std::uint8_t bounces = last_bounce - 1;  ///< reflections of what they send out
    std::uint32_t lamp_samples = 64;         ///< of each side of a disc
};

/// Light that discs send out after 1 reflection up to plan.bounces.
inline std::vector<std::vector<mir::SurfelRadiance>> light_discs(SceneStudy& s,
                                                                 const mir::SurfelTree& tree,
                                                                 const mir::GatherOptions& gather,
                                                                 const LightPlan& plan = {}) {
    mir::SurfelBounceOptions options;
    options.last = plan.bounces;
    options.least = 0.0f;
    options.gather = gather;
    options.gather.rays = 32;
    options.gather.directions = mir::GatherDirections::cosine;
    options.gather.threshold *= 32.0f / static_cast<float>(gather.rays);
    const mir::SurfelDirectLight<mir::Lambert, mir::cpu::EmbreeRayCaster,
                                 mir::cpu::EmbreeVisibility>
        direct({s.geometry, s.lights, s.surfaces, s.engine.ray_caster(), s.engine.visibility()},
               plan.lamp_samples, 1);
    return surfel_bounces(mir::SurfelPatches(tree), direct,
                          mir::TreeRays<mir::Space::host>{tree.view()}, s.geometry.ray_offset(),
                          options, s.executor);
}

/// `options` are those of rays or of a micro-buffer.
template <class Options>
mir::Image<mir::Rgb> gather(SceneStudy& s, const mir::SurfelTree& tree,
                            const std::vector<mir::SurfelRadiance>& radiance,
                            const Options& options) {
    return mir::gather_light<mir::Lambert>(s.gbuffer, tree, radiance, options, {0, s.rays.grid, 3},
                                           s.executor);
}

inline double mean_luminance(const mir::Image<mir::Rgb>& image) {
    double sum = 0.0;
    for (const mir::Rgb& p : image.pixels()) sum += static_cast<double>(luminance(p));
    return sum / static_cast<double>(image.pixels().size());
}

/// Errors in percent of the mean luminance of the truth: of the mean, and of tiles of 8 x 8 luxels
/// their root mean square and the largest.
struct TileError {
    double mean = 0.0;
    double rms = 0.0;
    double worst = 0.0;
};

inline TileError compare(const mir::Image<mir::Rgb>& image, const mir::Image<mir::Rgb>& truth) {
    const double mean = mean_luminance(truth);
    TileError error{100.0 * (mean_luminance(image) / mean - 1.0)};
    const auto tiles = mir::cut_into_tiles(truth.extent(), {8, 8});
    for (const mir::Tile& t : tiles) {
        double off = 0.0;
        for (std::uint32_t y = t.y; y < t.y + t.height; ++y)
            for (std::uint32_t x = t.x; x < t.x + t.width; ++x)
                off += double(luminance(image(x, y))) - double(luminance(truth(x, y)));
        off *= 100.0 / (t.width * t.height * mean);
        error.rms += off * off / static_cast<double>(tiles.size());
        error.worst = std::max(error.worst, std::fabs(off));
    }
    error.rms = std::sqrt(error.rms);
    return error;
}

}  // namespace mirstudy
