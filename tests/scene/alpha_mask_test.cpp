// SPDX-License-Identifier: MIT
#include "mir/scene/alpha_mask.hpp"

#include "mir/core/random.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/scene/scene_hash.hpp"
#include "support/catch.hpp"
#include "support/textured_scene.hpp"

#include <limits>
#include <optional>

using namespace mirtest;
using mir::Vec2;

namespace {

/// textured_triangle() of this alpha and cutoff; alphas of its texels are 0, 102 above 204, 255.
mir::Scene masked_triangle(float alpha, float cutoff, bool textured = true) {
    mir::Material m = mir::lambertian("leaf", {0.5f, 0.5f, 0.5f});
    m.alpha = alpha;
    m.alpha_cutoff = cutoff;
    if (textured) m.textures.base_color = texture_of(0);
    mir::Scene scene = textured_triangle(m);
    scene.images[0].texels = {texel(9, 9, 9, 0), texel(9, 9, 9, 102), texel(9, 9, 9, 204),
                              texel(9, 9, 9, 255)};
    return scene;
}

/// Whether the triangle is there at barycentrics of its second and third corner, which lie at x and
/// y half of them.
bool is_solid(const mir::Scene& scene, Vec2 barycentrics) {
    return mir::WorldGeometry(scene).alpha_masks().is_solid(0, barycentrics);
}

/// Barycentrics of the middles of the lower texels.
constexpr Vec2 lower_left{0.125f, 0.125f};
constexpr Vec2 lower_right{0.375f, 0.125f};

}  // namespace

TEST_CASE("a point is there when its alpha is at least the cutoff") {
    CHECK(is_solid(masked_triangle(1.0f, 0.8f), lower_left));
    CHECK_FALSE(is_solid(masked_triangle(1.0f, std::nextafter(0.8f, 1.0f)), lower_left));
    CHECK(is_solid(masked_triangle(1.0f, 1.0f), lower_right));
    CHECK_FALSE(is_solid(masked_triangle(1.0f, 2.0f), lower_right));
    CHECK(is_solid(masked_triangle(0.5f, 0.5f, false), lower_left));
    CHECK_FALSE(is_solid(masked_triangle(0.4f, 0.5f, false), lower_left));
}

TEST_CASE("the factor multiplies the texture's alpha") {
    CHECK(is_solid(masked_triangle(0.75f, 0.59f), lower_left));
    CHECK_FALSE(is_solid(masked_triangle(0.75f, 0.61f), lower_left));
}

TEST_CASE("alpha is linear, and mixed between texels as colours are") {
    mir::Scene scene = masked_triangle(1.0f, 0.9f);
    // Between 204 and 255 codes, 0.9 lies in the middle.
    CHECK_FALSE(is_solid(scene, {0.24f, 0.125f}));
    CHECK(is_solid(scene, {0.26f, 0.125f}));
    scene.materials[0].textures.base_color.nearest = true;
    CHECK_FALSE(is_solid(scene, {0.24f, 0.125f}));
    CHECK(is_solid(scene, {0.26f, 0.125f}));
    scene.materials[0].alpha_cutoff = 0.85f;
    CHECK_FALSE(is_solid(scene, {0.24f, 0.125f}));
}

TEST_CASE("a scene without masks has none to ask") {
    mir::Scene scene = masked_triangle(0.0f, 0.0f);
    CHECK(mir::WorldGeometry(scene).is_opaque());
    CHECK_FALSE(mir::WorldGeometry(scene).alpha_masks().exists());
    CHECK(is_solid(scene, lower_left));
    scene.add(mir::lambertian("other", {1, 1, 1}));
    scene.materials.back().alpha_cutoff = 0.5f;
    CHECK_FALSE(mir::WorldGeometry(scene).is_opaque());
    CHECK(is_solid(scene, lower_left));
}

TEST_CASE("masks outlive the scene that they were made of, and copies of the geometry") {
    std::optional<mir::Scene> scene = masked_triangle(1.0f, 0.9f);
    std::optional<mir::WorldGeometry> first(*scene);
    const mir::WorldGeometry second = *first;
    scene->images[0].texels.assign(4, 0);
    scene.reset();
    first.reset();
    CHECK_FALSE(second.alpha_masks().is_solid(0, lower_left));
    CHECK(second.alpha_masks().is_solid(0, lower_right));
}

TEST_CASE("alphas and cutoffs that mean nothing are refused with the name of the material") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const auto message = [](float alpha, float cutoff) -> std::string {
        try {
            mir::WorldGeometry{masked_triangle(alpha, cutoff)};
        } catch (const mir::Error& e) {
            CHECK(e.code() == mir::ErrorCode::invalid_input);
            return e.what();
        }
        return "";
    };
    for (const float alpha : {-0.1f, 1.1f, nan})
        CHECK(message(alpha, 0.0f).find("'leaf': its alpha is") != std::string::npos);
    for (const float cutoff : {-0.1f, infinity, nan})
        CHECK(message(1.0f, cutoff).find("'leaf': its alpha cutoff is") != std::string::npos);
    CHECK(message(1.0f, 5.0f).empty());
    mir::Scene missing = masked_triangle(1.0f, 0.5f);
    missing.images.clear();
    CHECK_THROWS_AS(mir::WorldGeometry(missing), mir::Error);
}

TEST_CASE("masks change the hash, alpha without one does not") {
    const auto hash = [](float alpha, float cutoff) {
        return mir::SceneHash(masked_triangle(alpha, cutoff)).hex();
    };
    CHECK(hash(1.0f, 0.0f) == hash(0.3f, 0.0f));
    CHECK(hash(1.0f, 0.0f) != hash(1.0f, 0.5f));
    CHECK(hash(1.0f, 0.6f) != hash(1.0f, 0.5f));
    CHECK(hash(0.9f, 0.5f) != hash(1.0f, 0.5f));
}

TEST_CASE("a masked lamp shines where it is there", "[statistical]") {
    // H0: the samples' mean of L / p is the integral of the radiance over what is left; z-test,
    // level 1e-6, seed 8. Half of the area of 2 is left: see "a textured lamp sends out the light
    // of its texels".
    mir::Scene scene = masked_triangle(1.0f, 0.5f);
    scene.materials[0].textures.base_color.nearest = true;
    scene.materials[0].emission = {2, 2, 2};
    scene.images[0].texels = {texel(0, 0, 0, 255), texel(0, 0, 0, 0), texel(0, 0, 0, 0),
                              texel(0, 0, 0, 255)};
    const mir::WorldGeometry geometry(scene);
    const mir::LightTable lights(scene, geometry);
    mir::Random random(8, mir::Stream::test, 0);
    double sum = 0.0;
    double squares = 0.0;
    constexpr int n = 40000;
    for (int i = 0; i < n; ++i) {
        const float u = random.next();
        const auto s = lights.sample_emitter(u, random.next_2d());
        const double x = double{s.radiance.r} / s.pdf_area;
        sum += x;
        squares += x * x;
        const bool there = geometry.alpha_masks().is_solid(s.triangle, s.barycentrics);
        REQUIRE(there == (s.radiance.r > 0.0f));
    }
    const double mean = sum / n;
    const double error = std::sqrt((squares / n - mean * mean) / n);
    CHECK(std::fabs(mean - 2.0) < 5.0 * error);
    CHECK(error < 0.02);
}
