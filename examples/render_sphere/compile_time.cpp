// SPDX-License-Identifier: MIT
#include "mir/cpu/embree_scene.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/io/exr.hpp"
#include "mir/mir.hpp"
#include "mir/scenes.hpp"

int main() {
    using Bsdf = mir::Lambert;
    const mir::Scene scene = mir::builtin::make("sphere");
    const mir::WorldGeometry geometry(scene);
    const mir::SurfaceTable<Bsdf> surfaces(scene);
    const mir::LightTable lights(scene, geometry);
    const mir::cpu::EmbreeScene embree(geometry);
    mir::TbbExecutor cores;

    // What the camera sees: one luxel per pixel.
    const mir::CameraRays rays{scene.cameras[0], {{320, 240}}};
    mir::BlockedGBuffer<Bsdf::Params> luxels(rays.grid.luxels(), {256, 256});
    fill_gbuffer(luxels, 0, rays, embree.ray_caster(), surfaces, cores);

    // What lights it: virtual point lights, on the lamps too, all of equal weight in the image.
    const mir::VplShading<Bsdf> shading{.bound = 1.0f};
    const mir::PathWorld world{
        geometry,    lights,      surfaces,     embree.ray_caster(), embree.visibility(),
        rays.camera, 4.0f / 3.0f, shading.bound};
    mir::MetropolisOptions options;
    options.states = 1024;
    options.emitter_vpls = true;
    const mir::PlacedVpls placed = place_vpls(mir::MetropolisSampler(world, options), luxels,
                                              embree.visibility(), shading, cores);

    // Every VPL through every luxel.
    const auto image = reconstruct(mir::sched::CpuBlocks{cores}, luxels, placed.vpls.span(),
                                   embree.visibility(), shading);
    mir::write_exr("sphere.exr", image.extent(), {{"", &image}});
}
