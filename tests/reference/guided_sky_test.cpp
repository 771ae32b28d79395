// SPDX-License-Identifier: MIT
#include "mir/direct_light.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"
#include "support/test_sky.hpp"
#include "support/traced_scene.hpp"

namespace {

using mir::CookTorrance;

constexpr std::uint32_t side = mir::BlockedLayout::side;

/// 16 x 16 luxels that look at a scene.
class Block {
 public:
    explicit Block(mir::Scene scene)
        : traced_(std::move(scene)), luxels_({side, side}, {side, side}) {
        mir::fill_gbuffer<CookTorrance>(luxels_, 0,
                                        mir::CameraRays{traced_.scene.cameras.front(), grid(), 5},
                                        traced_.engine.ray_caster(), traced_.surfaces, executor_);
    }

    /// Mean luminance of their direct light.
    [[nodiscard]] double mean_light(bool is_guided, std::uint64_t seed) const {
        mir::DirectSamples samples(8);
        samples.guides_sky = is_guided;
        mir::InlineExecutor executor;
        const auto light =
            mir::direct_light<CookTorrance>(luxels_, traced_.lights, traced_.engine.visibility(),
                                            {0, grid(), seed}, samples, executor);
        double sum = 0.0;
        for (const mir::Rgb& radiance : light.pixels())
            sum += static_cast<double>(luminance(radiance));
        return sum / (side * side);
    }

 private:
    static mir::LuxelGrid grid() { return mir::luxel_grid({side, side}, 1); }

    mirtest::TracedScene<CookTorrance> traced_;
    mir::InlineExecutor executor_;
    mir::BlockedGBuffer<CookTorrance::Params> luxels_;
};

/// A floor below a lid with a window of 0.8 m, under the sky.
mir::Scene below_a_window(const mir::Environment& sky, float roughness) {
    mir::Scene scene;
    mir::Material floor = mir::lambertian("floor", {0.5f, 0.5f, 0.5f});
    floor.specular = 1.0f;
    floor.roughness = roughness;
    const auto grey = scene.add(floor);
    const auto quad = [&](mir::Vec3 corner, mir::Vec3 u, mir::Vec3 v) {
        scene.place(mir::builtin::quad("part", grey, corner, u, v));
    };
    quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
    quad({-40, 1, 40}, {39.6f, 0, 0}, {0, 0, -80});
    quad({0.4f, 1, 40}, {40, 0, 0}, {0, 0, -80});
    quad({-0.4f, 1, -0.4f}, {0.8f, 0, 0}, {0, 0, -40});
    quad({-0.4f, 1, 40}, {0.8f, 0, 0}, {0, 0, -39.6f});
    scene.environment = sky;
    scene.cameras.push_back(mir::Camera::look_at({0, 0.9f, 1.9f}, {0, 0, 0}, {0, 1, 0}, 0.1f));
    return scene;
}

}  // namespace

// H0: behind a window direct light of a sky has one mean with a guide and without. Welch's t over
// 400 pictures of a block each, seeds 1 to 1400; family level 1 %.
TEST_CASE("a guide keeps the light of a sky behind a window and takes its noise", "[statistical]") {
    for (const bool has_sun : {false, true})
        for (const float roughness : {1.0f, 0.3f}) {
            const Block block(below_a_window(
                has_sun ? mirtest::test_sky() : mirtest::constant_sky({1, 1, 1}), roughness));
            mirtest::Moments guided;
            mirtest::Moments plain;
            for (std::uint64_t seed = 1; seed <= 400; ++seed) {
                guided.add(block.mean_light(true, seed));
                plain.add(block.mean_light(false, 1000 + seed));
            }
            CAPTURE(has_sun, roughness, guided.mean(), plain.mean());
            CHECK(mirtest::welch_p_value(guided, plain) > mirtest::sidak(0.01, 4));
            // Of the sky with a sun the luxels see the rim of a narrow part.
            if (!has_sun) CHECK(guided.variance() < 0.4 * plain.variance());
        }
}
