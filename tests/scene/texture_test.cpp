// SPDX-License-Identifier: MIT
#include "mir/core/random.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/scene/scene_hash.hpp"
#include "mir/scene/texture_table.hpp"
#include "support/catch.hpp"
#include "support/textured_scene.hpp"

#include <limits>

using namespace mirtest;
using mir::Rgb;
using mir::TexelEncoding;
using mir::Texture;
using mir::Vec2;
using mir::Wrap;

namespace {

/// Codes 0, 51, 102, 153, 204, 255 in the red of an image of 3 x 2.
mir::Scene ramp() {
    mir::Scene scene;
    scene.images.push_back({"ramp", 3, 2, {0, 51, 102, 153, 204, 255}});
    return scene;
}

float red(const Texture& texture, Vec2 uv, TexelEncoding encoding = TexelEncoding::linear) {
    static const mir::Scene scene = ramp();
    static const mir::TextureTable table(scene);
    return table.view().color(texture, uv, encoding).r;
}

}  // namespace

TEST_CASE("texels are exact at their centres and mix linearly between") {
    const Texture t = texture_of(0);
    CHECK(red(t, {0.5f / 3.0f, 0.25f}) == Approx(0.0).margin(1e-6));
    CHECK(red(t, {1.5f / 3.0f, 0.25f}) == Approx(0.2));
    CHECK(red(t, {2.5f / 3.0f, 0.75f}) == Approx(1.0));
    CHECK(red(t, {1.0f / 3.0f, 0.25f}) == Approx(0.1));
    CHECK(red(t, {0.5f, 0.5f}) == Approx(0.5));
    CHECK(red(t, {0.5f, 0.375f}) == Approx(0.75 * 0.2 + 0.25 * 0.8));
}

TEST_CASE("beyond an image it is repeated, clamped or mirrored, each way on its own") {
    Texture t = texture_of(0);
    // At the left edge a repeated image mixes with its right column.
    CHECK(red(t, {0.0f, 0.25f}) == Approx(0.5 * (0.0 + 0.4)));
    CHECK(red(t, {-7.5f, 0.25f}) == Approx(0.2));
    CHECK(red(t, {4.5f, 1.25f}) == Approx(0.2));
    t.wrap_u = Wrap::clamp;
    CHECK(red(t, {0.0f, 0.25f}) == Approx(0.0).margin(1e-6));
    CHECK(red(t, {9.0f, 0.25f}) == Approx(0.4));
    CHECK(red(t, {9.0f, 1.75f}) == Approx(1.0));
    t.wrap_u = Wrap::mirror;
    CHECK(red(t, {1.0f + 0.5f / 3.0f, 0.25f}) == Approx(0.4));
    CHECK(red(t, {2.0f - 0.5f / 3.0f, 0.25f}) == Approx(0.0).margin(1e-5));
    CHECK(red(t, {-0.5f, 0.25f}) == Approx(0.2));
    CHECK(red(t, {1.0f, 0.25f}) == Approx(0.4));
}

TEST_CASE("the nearest texel is taken where that is asked for") {
    Texture t = texture_of(0);
    t.nearest = true;
    CHECK(red(t, {0.3f, 0.2f}) == 0.0f);
    CHECK(red(t, {0.34f, 0.2f}) == Approx(0.2));
    CHECK(red(t, {0.999f, 0.999f}) == 1.0f);
    t.wrap_u = t.wrap_v = Wrap::clamp;
    CHECK(red(t, {1.0f, 1.0f}) == 1.0f);
}

TEST_CASE("coordinates that are no use do no harm") {
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
        Texture t = texture_of(0);
        t.wrap_u = t.wrap_v = wrap;
        for (const float bad : {std::numeric_limits<float>::quiet_NaN(),
                                std::numeric_limits<float>::infinity(), -3e38f, 1e20f, -1e-30f}) {
            const float value = red(t, {bad, bad});
            CHECK(value >= 0.0f);
            CHECK(value <= 1.0f);
        }
    }
}

TEST_CASE("sRGB codes become linear before they are mixed, alpha never is") {
    CHECK(red(texture_of(0), {0.5f, 0.25f}, TexelEncoding::srgb) == Approx(0.0331047666));
    const double mean = 0.5 * (0.0331047666 + 0.6038273389);
    CHECK(red(texture_of(0), {0.5f, 0.5f}, TexelEncoding::srgb) == Approx(mean));
    mir::Scene scene;
    scene.images.push_back({"half", 1, 1, {texel(255, 10, 0, 51)}});
    const mir::TextureTable table(scene);
    const auto c = table.view().look_up(texture_of(0), {0.3f, 0.9f}, TexelEncoding::srgb);
    CHECK(c.x == 1.0f);
    CHECK(c.y == Approx(10.0 / 255.0 / 12.92));
    CHECK(c.w == Approx(0.2));
    CHECK(mir::mean_of(scene.images[0], TexelEncoding::linear).g == Approx(10.0 / 255.0));
}

TEST_CASE("a placed texture is read where its matrix says") {
    Texture t = texture_of(0);
    t.u_axis = {0, 2};
    t.v_axis = {-1, 0};
    t.offset = {0.5f, 0.25f};
    const Vec2 at = t.place({0.25f, 0.75f});
    CHECK(at.x == Approx(0.5 - 0.75));
    CHECK(at.y == Approx(0.25 + 0.5));
    CHECK(red(t, {0.25f, 0.75f}) == Approx(red(texture_of(0), at)));
}

TEST_CASE("images that do not fit and materials that name none are refused") {
    mir::Scene scene = ramp();
    scene.images[0].width = 4;
    CHECK_THROWS_AS(mir::TextureTable(scene), mir::Error);
    scene = ramp();
    mir::Material m;
    m.textures.normal = texture_of(1);
    scene.add(m);
    CHECK_THROWS_AS(mir::TextureTable(scene), mir::Error);
}

TEST_CASE("a textured lamp sends out the light of its texels") {
    // H0: the samples' mean of L / p is the integral of the radiance; z-test, level 1e-6, seed 7.
    mir::Material lamp = mir::emitter("lamp", {0, 0, 0}, {2, 3, 4});
    lamp.textures.emission = texture_of(0);
    lamp.textures.emission.nearest = true;
    const mir::Scene scene = textured_triangle(lamp);
    const mir::WorldGeometry geometry(scene);
    const mir::LightTable lights(scene, geometry);
    mir::Random random(7, mir::Stream::pilot, 0);
    double sum = 0.0;
    double squares = 0.0;
    constexpr int n = 40000;
    for (int i = 0; i < n; ++i) {
        const float u = random.next();
        const auto s = lights.sample_emitter(u, random.next_2d());
        const double x = double{s.radiance.r} / s.pdf_area;
        sum += x;
        squares += x * x;
    }
    const double mean = sum / n;
    const double error = std::sqrt((squares / n - mean * mean) / n);
    // Red is in two of four texels. The triangle, x + y < 2, has one image whole and the lower left
    // halves of two, each again half red: an area of 1/2 + 1/4 + 1/4, of radiance 2.
    CHECK(std::fabs(mean - 2.0) < 5.0 * error);
    CHECK(error < 0.02);
    CHECK(lights.power() > 0.0);
}

TEST_CASE("textures, images, coordinates and colours change the hash") {
    mir::Material m;
    m.textures.base_color = texture_of(0);
    const mir::Scene scene = textured_triangle(m);
    const std::string hash = mir::SceneHash(scene).hex();
    mir::Scene other = scene;
    other.images[0].texels[3] = 0;
    CHECK(mir::SceneHash(other).hex() != hash);
    other = scene;
    other.materials[0].textures.base_color.wrap_v = Wrap::clamp;
    CHECK(mir::SceneHash(other).hex() != hash);
    other = scene;
    std::swap(other.materials[0].textures.base_color, other.materials[0].textures.emission);
    CHECK(mir::SceneHash(other).hex() != hash);
    other = scene;
    other.meshes[0].texture_coordinates[1].x += 1.0f;
    CHECK(mir::SceneHash(other).hex() != hash);
    other = scene;
    other.meshes[0].colors.assign(3, Rgb{1, 1, 1});
    CHECK(mir::SceneHash(other).hex() != hash);
}
