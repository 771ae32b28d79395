// SPDX-License-Identifier: MIT
#include "mir/cpu/embree_scene.hpp"
#include "mir/cpu/tbb_executor.hpp"
#include "mir/io/exr.hpp"
#include "mir/mir.hpp"

int main() {
    using Bsdf = mir::Lambert;
    const mir::Scene scene = mir::builtin::make("sphere");
    const mir::WorldGeometry geometry(scene);
    const mir::SurfaceTable<Bsdf> surfaces(scene);
    const mir::LightTable lights(scene, geometry);
    const mir::cpu::EmbreeScene embree(geometry);
    mir::cpu::TbbExecutor cores;

    // What the camera sees: one luxel per pixel.
    const mir::CameraRays rays{scene.cameras[0], {{320, 240}}};
    mir::BlockedGBuffer<Bsdf::Params> luxels(rays.grid.luxels(), {256, 256});
    fill_gbuffer(luxels, 0, rays, embree.ray_caster(), surfaces, geometry.ray_offset(), cores);

    // What lights it: virtual point lights, on the lamps too.
    const mir::InstantRadiositySampler<Bsdf, mir::cpu::EmbreeRayCaster> sampler(
        {geometry, lights, surfaces, embree.ray_caster()}, {.vpls = 1024, .emitter_vpls = true});
    const mir::VplList vpls = aggregate(sampler.sample(cores));

    // Every VPL through every luxel.
    const auto image = reconstruct(mir::sched::CpuBlocks{cores}, luxels, vpls.span(),
                                   embree.visibility(), mir::VplShading<Bsdf>{.bound = 1.0f});
    mir::write_exr("sphere.exr", image.extent(), {{"", &image}});
}
