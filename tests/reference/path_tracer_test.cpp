// SPDX-License-Identifier: MIT
#include "mir/reference/path_tracer.hpp"

#include "mir/direct_light.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "studio.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::CookTorrance;
using mir::Lambert;
using mir::LightSearch;
using mir::Rgb;
using mir::Vec3;

namespace {

/// The Cornell box seen from the middle of its floor, lamp in view.
mir::Scene box() {
    mir::Scene s = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    s.cameras = {mir::Camera::look_at({0, 0.7f, 0.9f}, {0, 1.6f, 0}, {0, 1, 0}, 1.0f)};
    return s;
}

/// The Cornell box with its lamp put out.
mir::Scene dark_box() {
    mir::Scene s = box();
    for (mir::Material& m : s.materials) m.emission = {};
    return s;
}

/// The Cornell box lit by one light of each kind without extent.
mir::Scene delta_box() {
    mir::Scene s = dark_box();
    s.point_lights.push_back({"bulb", {0.4f, 1.6f, 0.5f}, {2.0f, 1.5f, 1.0f}});
    s.spot_lights.push_back({"spot", {0, 1.8f, 0.8f}, {0, -1, 0}, {4.0f, 4.0f, 5.0f}, 0.95f, 0.8f});
    s.directional_lights.push_back(
        {"sun", glm::normalize(Vec3(0.1f, -0.2f, -1.0f)), {1.0f, 0.9f, 0.8f}});
    return s;
}

template <mir::Bsdf B>
mir::BlockedGBuffer<typename B::Params> luxels(const Studio<B>& studio, const mir::CameraRays& r) {
    mir::BlockedGBuffer<typename B::Params> g(r.grid.luxels(), {16, 16});
    mir::InlineExecutor executor;
    mir::fill_gbuffer<B>(g, 0, r, studio.engine.ray_caster(), studio.surfaces, executor);
    return g;
}

template <mir::Bsdf B>
mir::ReferenceImage small_image(const Studio<B>& studio, const mir::PathTracerOptions& options) {
    mir::ReferenceOptions reference;
    reference.samples = 4;
    reference.replicates = 2;
    mir::InlineExecutor executor;
    return trace_reference(studio.tracer(options), studio.rays(24, 7), reference, executor);
}

bool is_black(const mir::Image<Rgb>& image) {
    for (const Rgb& c : image.pixels())
        if (!(c == Rgb{})) return false;
    return true;
}

bool is_sound(const mir::Image<Rgb>& image) {
    for (const Rgb& c : image.pixels())
        if (!mir::is_finite(c) || c.r < 0.0f || c.g < 0.0f || c.b < 0.0f) return false;
    return true;
}

}  // namespace

TEST_CASE("direct light of lights without extent is that of direct_light(), exactly") {
    const Studio<CookTorrance> studio(delta_box());
    const auto rays = studio.rays(48, 3);
    const auto g = luxels(studio, rays);
    mir::InlineExecutor executor;
    const auto expected = mir::direct_light<CookTorrance>(
        g, studio.lights, studio.engine.visibility(), {0, rays.grid, 3}, 4, executor);
    const auto search = GENERATE(LightSearch::mis, LightSearch::lamps, LightSearch::directions);
    mir::ReferenceOptions options;
    options.samples = options.replicates = 2;
    const auto image = trace_reference(studio.tracer({.light = search}), rays, options, executor);
    const mir::Image<Rgb> direct = image.bounce(1);
    CHECK_FALSE(is_black(direct));
    for (std::size_t i = 0; i < direct.pixels().size(); ++i)
        REQUIRE(direct.pixels()[i] == expected.pixels()[i]);
    CHECK(is_black(image.bounce(0)));
    CHECK_FALSE(is_black(image.bounce(2)));
}

TEST_CASE("a path starts at the luxel that the G-buffer holds") {
    const Studio<Lambert> studio(mir::builtin::sphere_room(mir::builtin::Lamp::down));
    mir::CameraRays rays = studio.rays(16, 5);
    rays.camera.lens_radius = 0.05f;
    rays.grid = mir::luxel_grid({16, 16}, 4);
    const auto g = luxels(studio, rays);
    const auto tracer = studio.tracer({});
    for (mir::TileIndex t = 0; t < g.tiles().size(); ++t) {
        const mir::Tile tile = g.tiles()[t];
        for (std::uint32_t y = 0; y < tile.height; ++y)
            for (std::uint32_t x = 0; x < tile.width; ++x) {
                const auto luxel = tracer.luxel(rays(tile.x + x, tile.y + y));
                const auto i = mir::BlockedLayout::of(tile)(x, y);
                REQUIRE_FALSE(is_empty(luxel.hit));
                REQUIRE(luxel.hit.position == g.view(t).hit(i).position);
                REQUIRE(luxel.surface.normal == g.view(t).surface(i).normal);
            }
    }
}

TEST_CASE("emission seen directly is D_0 and has no variance") {
    const Studio<Lambert> studio(box());
    const auto image = small_image(studio, {});
    const auto rays = studio.rays(24, 7);
    const auto tracer = studio.tracer({});
    const mir::Image<Rgb> emission = image.bounce(0);
    for (std::uint32_t y = 0; y < 24; ++y)
        for (std::uint32_t x = 0; x < 24; ++x) {
            REQUIRE(emission(x, y) == tracer.luxel(rays(x, y)).surface.emission);
        }
    CHECK_FALSE(is_black(emission));
    CHECK(is_black(image.bounce_variance(0)));
}

TEST_CASE("light stops after the largest bounce") {
    const Studio<Lambert> studio(box());
    for (LightSearch search : {LightSearch::mis, LightSearch::lamps, LightSearch::directions}) {
        std::array<mir::RgbSum, 3> bounces{};
        const auto tracer = studio.tracer({.light = search, .max_bounce = 2});
        const auto first = tracer.luxel({{0, 1, 0.9f}, {0, -1, 0}});
        REQUIRE_FALSE(is_empty(first.hit));
        mir::Random random(9, mir::Stream::reference, 0);
        for (int i = 0; i < 2000; ++i) tracer.trace(first, random, bounces);
        CHECK(bounces[1].channel[0] > 0.0);
        CHECK(bounces[2].channel[0] > 0.0);
    }
    CHECK(small_image(studio, {.max_bounce = 2}).last_bounce() == 2);
}

TEST_CASE("later bounces than there is room for go to the last element") {
    const Studio<Lambert> studio(box());
    const auto tracer = studio.tracer({});
    const auto first = tracer.luxel({{0, 1, 0.9f}, {0, -1, 0}});
    REQUIRE_FALSE(is_empty(first.hit));
    std::array<mir::RgbSum, 3> few{};
    std::array<mir::RgbSum, 64> many{};
    mir::Random random(9, mir::Stream::reference, 0);
    mir::Random same = random;
    for (int i = 0; i < 200; ++i) {
        tracer.trace(first, random, few);
        tracer.trace(first, same, many);
    }
    double later = 0.0;
    for (std::size_t b = 2; b < many.size(); ++b) later += many[b].channel[0];
    CHECK(few[1].channel[0] == many[1].channel[0]);
    CHECK(few[2].channel[0] == Approx(later).epsilon(1e-12));
    CHECK(later > many[2].channel[0]);
}

TEST_CASE("paths end between white walls") {
    const Studio<Lambert> studio(mir::builtin::furnace_box(1.0f, 1.0f));
    CHECK(is_sound(small_image(studio, {}).beauty()));
}

TEST_CASE("scenes without light, without reflection, without anything give black") {
    mir::Scene black = box();
    for (mir::Material& m : black.materials) m.base_color = {};
    mir::Scene empty;
    empty.cameras.emplace_back();
    for (LightSearch search : {LightSearch::mis, LightSearch::lamps, LightSearch::directions}) {
        CHECK(is_black(small_image(Studio<Lambert>(dark_box()), {.light = search}).beauty()));
        CHECK(is_black(small_image(Studio<Lambert>(empty), {.light = search}).beauty()));
        const auto image = small_image(Studio<Lambert>(black), {.light = search});
        CHECK_FALSE(is_black(image.bounce(0)));
        for (std::uint8_t b = 1; b <= image.last_bounce(); ++b) CHECK(is_black(image.bounce(b)));
    }
}

TEST_CASE("a camera inside a solid sees its inside, and nothing breaks") {
    mir::Scene scene = delta_box();
    scene.cameras = {mir::Camera::look_at({-0.42f, 0.4f, -0.15f}, {1, 1, 1}, {0, 1, 0}, 1.5f)};
    mir::Scene inside_lamp = mir::builtin::sphere_room(mir::builtin::Lamp::up);
    inside_lamp.cameras = {mir::Camera::look_at({0, 1.4f, 0}, {1, 1, 1}, {0, 1, 0}, 1.5f)};
    inside_lamp.materials[2].emission = {1, 1, 1};
    inside_lamp.materials[2].emits_from_both_sides = true;
    for (LightSearch search : {LightSearch::mis, LightSearch::lamps, LightSearch::directions}) {
        CHECK(is_black(small_image(Studio<Lambert>(scene), {.light = search}).beauty()));
        const auto lit = small_image(Studio<CookTorrance>(inside_lamp), {.light = search});
        CHECK(is_sound(lit.beauty()));
        CHECK_FALSE(is_black(lit.bounce(2)));
    }
}

TEST_CASE("options out of range are refused") {
    const Studio<Lambert> studio(mir::builtin::furnace_box());
    CHECK_THROWS_AS(studio.tracer({.light_samples = 0}), mir::Error);
    CHECK_THROWS_AS(studio.tracer({.directions = 0}), mir::Error);
    CHECK_THROWS_AS(studio.tracer({.max_bounce = 0}), mir::Error);
    CHECK_THROWS_AS(studio.tracer({.max_bounce = 255}), mir::Error);
    CHECK_THROWS_AS(studio.tracer({.roulette_from = 0}), mir::Error);
    CHECK_THROWS_AS(studio.tracer({.roulette_from = 255}), mir::Error);
    CHECK_NOTHROW(studio.tracer({.max_bounce = 254, .roulette_from = 255}));
    CHECK_THROWS_AS(studio.tracer({.bound = 0.0f}), mir::Error);
}
