// SPDX-License-Identifier: MIT
//
// Quoted by docs/reference.md: a reference image from a scene.
#include "mir/cpu/embree_scene.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/reference/trace_reference.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "support/catch.hpp"

TEST_CASE("a reference image takes a scene, an engine and an executor") {
    // region: reference
    const mir::Scene scene = mir::builtin::make("cornell-box");
    const mir::WorldGeometry geometry(scene);
    const mir::LightTable lights(scene, geometry);
    const mir::SurfaceTable<mir::CookTorrance> surfaces(scene);
    const mir::cpu::EmbreeScene engine(geometry);
    mir::TbbExecutor executor;

    mir::PathTracerOptions paths;
    paths.max_bounce = 3;  // L_3
    using Tracer =
        mir::PathTracer<mir::CookTorrance, mir::cpu::EmbreeRayCaster, mir::cpu::EmbreeVisibility>;
    const Tracer tracer({geometry, lights, surfaces, engine.ray_caster(), engine.visibility()},
                        paths);

    const mir::CameraRays rays{scene.cameras.front(), mir::luxel_grid({64, 64}, 1), 0};
    mir::ReferenceOptions options;
    options.samples = 4;
    const mir::ReferenceImage image = mir::trace_reference(tracer, rays, options, executor);

    const mir::Image<mir::Rgb> indirect = image.bounce(2);          // D_2
    const mir::Image<mir::Rgb> l2 = image.up_to(2);                 // L_2 = D_0 + D_1 + D_2
    const mir::Image<mir::Rgb> variance = image.beauty_variance();  // of the mean, per pixel
    // endregion: reference
    CHECK(indirect(32, 40).r > 0.0f);
    CHECK(l2(32, 40).r > indirect(32, 40).r);
    CHECK(variance(32, 40).r > 0.0f);
}
