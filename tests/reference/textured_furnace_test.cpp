// SPDX-License-Identifier: MIT
#include "mir/cpu/embree_scene.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/scene/check_rooms.hpp"
#include "support/catch.hpp"
#include "support/textured_scene.hpp"

#include <cmath>
#include <vector>

using namespace mirtest;

namespace {

/// The furnace with walls whose reflectance and emission are checked by textures so that they add
/// up to 1 everywhere, mixed texels included: the radiance is 1 in all directions.
mir::Scene textured_furnace() {
    mir::Scene scene = mir::builtin::furnace_box();
    const float half = mir::texel_values()[256 + 188];
    // Where the base is white (255) the walls emit `half`, where it is black they emit 1.
    scene.images.push_back({"base", 2, 2, {texel(255, 255, 255), 0, 0, texel(255, 255, 255)}});
    const std::uint32_t one = texel(255, 255, 255);
    const std::uint32_t less = texel(188, 188, 188);
    scene.images.push_back({"emission", 2, 2, {less, one, one, less}});
    mir::Material& wall = scene.materials[0];
    wall.base_color = {1.0f - half, 1.0f - half, 1.0f - half};
    wall.emission = {1, 1, 1};
    wall.textures.base_color = texture_of(0);
    wall.textures.emission = texture_of(1);
    for (mir::Vec3 p : scene.meshes[0].positions)
        scene.meshes[0].texture_coordinates.emplace_back(1.3f * p.x + 0.7f * p.z,
                                                         1.1f * p.y - 0.4f * p.z);
    return scene;
}

}  // namespace

// H0: the mean of the paths' radiance is 1. z-test, 2 ways to find light, family level 1e-4,
// seed 3.
TEST_CASE("a furnace with textured walls has radiance 1", "[statistical]") {
    const mir::Scene scene = textured_furnace();
    const mir::WorldGeometry geometry(scene);
    const mir::SurfaceTable<mir::Lambert> surfaces(scene);
    const mir::LightTable lights(scene, geometry);
    const mir::cpu::EmbreeScene embree(geometry);
    for (const auto light : {mir::LightSearch::lamps, mir::LightSearch::directions}) {
        mir::PathTracerOptions options;
        options.light = light;
        const mir::PathTracer<mir::Lambert, decltype(embree.ray_caster()),
                              decltype(embree.visibility())>
            tracer({geometry, lights, surfaces, embree.ray_caster(), embree.visibility()}, options);
        mir::Random random(3, mir::Stream::pilot, static_cast<std::uint64_t>(light));
        double sum = 0.0;
        double squares = 0.0;
        constexpr int n = 40000;
        for (int i = 0; i < n; ++i) {
            const mir::Ray ray{{0, 0, 0}, mir::square_to_sphere(random.next_2d())};
            std::vector<mir::RgbSum> bounces(8);
            const auto first = tracer.luxel(ray);
            REQUIRE_FALSE(is_empty(first.hit));
            tracer.trace(first, random, bounces);
            double radiance = 0.0;
            for (const mir::RgbSum& b : bounces) radiance += b.channel[1];
            sum += radiance;
            squares += radiance * radiance;
        }
        const double mean = sum / n;
        const double error = std::sqrt((squares / n - mean * mean) / n);
        CAPTURE(int(light), mean, error);
        CHECK(std::fabs(mean - 1.0) < 4.06 * error);
        CHECK(error < 0.01);
    }
}
