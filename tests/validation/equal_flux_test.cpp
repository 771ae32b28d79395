// SPDX-License-Identifier: MIT
#include "mir/validation/equal_flux.hpp"

#include "conformance/brute_force.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/place_vpls.hpp"
#include "mir/sampling/metropolis_sampler.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "mir/validation/worlds.hpp"
#include "support/catch.hpp"
#include "validation/finds.hpp"

#include <limits>

namespace {

using mir::Lambert;

/// VPLs of the Cornell box by Metropolis sampling, and the luxels that they were made for.
struct Placed {
    mir::validation::World box{mir::builtin::cornell_box(mir::builtin::Lamp::down)};
    mirtest::BruteForceScene engine{box.geometry};
    mir::InlineExecutor executor;
    mir::VplShading<Lambert> shading{.bound = 5.0f};
    mir::BlockedGBuffer<Lambert::Params> luxels{{24, 24}, {32, 32}};
    mir::VplList vpls;

    Placed() {
        const mir::SurfaceTable<Lambert> surfaces(box.scene);
        const mir::LightTable lights(box.scene, box.geometry);
        const mir::CameraRays rays{box.scene.cameras[0], {{24, 24}}};
        mir::fill_gbuffer(luxels, 0, rays, engine.ray_caster(), surfaces, executor);
        const mir::PathWorld world{box.geometry,        lights,      surfaces, engine.ray_caster(),
                                   engine.visibility(), rays.camera, 1.0f,     shading.bound};
        mir::MetropolisOptions options;
        options.states = 64;
        vpls = mir::place_vpls(mir::MetropolisSampler(world, options), luxels, engine.visibility(),
                               shading, executor)
                   .vpls;
    }
    [[nodiscard]] mir::validation::Report check(const mir::VplList& list) {
        return mir::validation::check_equal_flux(luxels, list, engine.visibility(), shading,
                                                 executor);
    }
};

}  // namespace

TEST_CASE("check_equal_flux passes Metropolis VPLs and finds those that are brighter by 1 %") {
    Placed placed;
    const mir::validation::Report report = placed.check(placed.vpls);
    INFO(report.text());
    CHECK(report.passed());

    std::vector<mir::Rgb> intensities;
    for (const mir::PathVpl& p : placed.vpls.path_vpls()) intensities.push_back(p.intensity);
    for (std::size_t i = 0; i < intensities.size() / 2; ++i)
        intensities[i] = intensities[i] * 1.01f;
    mir::VplList brighter = placed.vpls;
    brighter.relight(intensities);
    const mir::validation::Report found = placed.check(brighter);
    INFO(found.text() << placed.vpls.size() << " VPLs of " << intensities.size() << " states");
    CHECK(mirtest::finds_only(found, "every recorded state brings the same light to the image"));

    const float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float value : {infinity, nan}) {
        brighter.relight(std::vector<mir::Rgb>(intensities.size(), {value, value, value}));
        CHECK(mirtest::finds_only(placed.check(brighter),
                                  "every recorded state brings the same light to the image"));
    }
    CHECK(mirtest::finds(placed.check({}), "luxels see most of the VPLs"));
}
