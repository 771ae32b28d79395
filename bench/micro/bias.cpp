// SPDX-License-Identifier: MIT
// Not a benchmark: one indirect bounce gathered from discs against D_2 of the path tracer, luxel by
// luxel, for several sizes of discs and thresholds. CSV on standard output. Arguments: the name of
// a built-in scene, paths per luxel of the reference.
#include "mir/cpu/embree_scene.hpp"
#include "mir/cpu/tbb_executor.hpp"
#include "mir/micro/gather_light.hpp"
#include "mir/micro/material_albedo.hpp"
#include "mir/micro/surfel_direct_light.hpp"
#include "mir/micro/surfel_tree_build.hpp"
#include "mir/reference/trace_reference.hpp"
#include "mir/scene/builtin.hpp"

#include <cstdio>
#include <string>

namespace {

using mir::Lambert;
using Params = Lambert::Params;

constexpr std::uint32_t side = 48;

struct Study {
    explicit Study(const std::string& name) : scene(mir::builtin::make(name)) {}

    mir::Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<Lambert> surfaces{scene};
    mir::cpu::EmbreeScene engine{geometry};
    mir::cpu::TbbExecutor executor;
    mir::CameraRays rays{scene.cameras.front(), {{side, side}}, 7};
};

double luminance_of(const mir::Image<mir::Rgb>& image) {
    double sum = 0.0;
    for (const mir::Rgb& p : image.pixels()) sum += static_cast<double>(luminance(p));
    return sum / static_cast<double>(image.pixels().size());
}

mir::Image<mir::Rgb> reference(Study& s, std::uint32_t samples) {
    const mir::PathTracer<Lambert, mir::cpu::EmbreeRayCaster, mir::cpu::EmbreeVisibility> tracer(
        {s.geometry, s.lights, s.surfaces, s.engine.ray_caster(), s.engine.visibility()},
        {.light = mir::LightSearch::lamps, .max_bounce = 2});
    mir::ReferenceOptions wanted;
    wanted.samples = samples;
    wanted.replicates = 1;
    wanted.last_bounce = 2;
    return trace_reference(tracer, s.rays, wanted, s.executor).bounce(2);
}

/// Mean error and root mean square error of 8 x 8 luxels, relative to the mean of the reference.
void compare(const mir::Image<mir::Rgb>& image, const mir::Image<mir::Rgb>& truth) {
    const double mean = luminance_of(truth);
    double squares = 0.0;
    double worst = 0.0;
    for (std::uint32_t y = 0; y < side; y += 8)
        for (std::uint32_t x = 0; x < side; x += 8) {
            double off = 0.0;
            for (std::uint32_t k = 0; k < 64; ++k) {
                const std::uint32_t px = x + k % 8;
                const std::uint32_t py = y + k / 8;
                off += double(luminance(image(px, py))) - double(luminance(truth(px, py)));
            }
            off /= 64.0 * mean;
            squares += off * off / 36.0;
            worst = std::max(worst, std::fabs(off));
        }
    std::printf("%.3f,%.3f,%.3f", 100.0 * (luminance_of(image) / mean - 1.0),
                100.0 * std::sqrt(squares), 100.0 * worst);
}

void run(Study& s, const mir::Image<mir::Rgb>& truth, float area, mir::DiscExtent extent,
         const mir::GatherOptions& options) {
    const auto albedo = mir::material_albedo(s.surfaces);
    const mir::SurfelTree tree(make_surfels(s.geometry, {area, extent}, {}, s.executor), albedo, {},
                               s.executor);
    const float offset = s.geometry.ray_offset();
    const auto radiance = light_surfels(
        tree, mir::SurfelDirectLight(s.lights, s.engine.visibility(), 64, 1), offset, s.executor);
    mir::BlockedGBuffer<Params> gbuffer({side, side}, {side, side});
    fill_gbuffer<Lambert>(gbuffer, 0, s.rays, s.engine.ray_caster(), s.surfaces, offset,
                          s.executor);
    const auto image = mir::gather_light<Lambert>(gbuffer, tree, radiance, options,
                                                  {0, s.rays.grid, 3}, s.executor);
    std::printf("%g,%zu,%s,%u,%s,%s,%g,", double(area), tree.surfels().size(),
                extent == mir::DiscExtent::cover ? "cover" : "equal", options.rays,
                options.directions == mir::GatherDirections::cosine ? "cosine" : "uniform",
                options.shape == mir::StopShape::disc ? "disc" : "sphere",
                double(options.threshold));
    compare(image, truth);
    std::printf("\n");
    std::fflush(stdout);
}

void run_all(Study& s, std::uint32_t samples) {
    const auto truth = reference(s, samples);
    std::printf("area,discs,extent,rays,directions,shape,threshold,mean,rmse,worst\n");
    for (float area : {0.04f, 0.01f, 2.5e-3f, 6e-4f, 1.5e-4f})
        for (auto extent : {mir::DiscExtent::cover, mir::DiscExtent::equal_area})
            run(s, truth, area, extent, {.rays = 256, .threshold = 0.0f});
    for (auto shape : {mir::StopShape::disc, mir::StopShape::sphere})
        for (float threshold : {0.25f, 1.0f, 4.0f, 16.0f, 64.0f})
            run(s, truth, 6e-4f, mir::DiscExtent::cover,
                {.rays = 256, .threshold = threshold, .shape = shape});
}

}  // namespace

int main(int argc, char** argv) try {
    Study study(argc > 1 ? argv[1] : "cornell-box");
    run_all(study, argc > 2 ? static_cast<std::uint32_t>(std::stoul(argv[2])) : 1024);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "micro_bias: %s\n", e.what());
    return 1;
}
