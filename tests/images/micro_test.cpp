// SPDX-License-Identifier: MIT
#include "images/support.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <array>
#include <cmath>

using mir::Integrator;
using mir::RenderResult;
using mir::RenderSettings;
using mirtest::Approx;
using mirtest::mean_luminance;

namespace {

RenderSettings micro_settings(std::uint32_t side) {
    RenderSettings s = mirtest::small_settings(side, 1);
    s.backend = mir::BackendKind::cpu;
    s.integrator = Integrator::micro;
    s.bounce_layers = true;
    s.micro.surfels = 4096;
    s.micro.surfel_rays = 8;
    s.micro.gather.rays = 256;
    return s;
}

RenderSettings path_settings(std::uint32_t side) {
    RenderSettings s = micro_settings(side);
    s.integrator = Integrator::path;
    s.path.samples = 512;
    return s;
}

/// Largest error of tiles of 8 x 8 pixels, relative to the mean.
double worst_tile(const mir::Image<mir::Rgb>& image, const mir::Image<mir::Rgb>& truth) {
    double worst = 0.0;
    for (const mir::Tile& t : mir::cut_into_tiles(image.extent(), {8, 8})) {
        double off = 0.0;
        for (std::uint32_t y = t.y; y < t.y + t.height; ++y)
            for (std::uint32_t x = t.x; x < t.x + t.width; ++x)
                off += double(luminance(image(x, y))) - double(luminance(truth(x, y)));
        worst = std::max(worst, std::fabs(off) / (t.width * t.height));
    }
    return worst / mean_luminance(truth);
}

/// Four walls without thickness, open above and below.
void place_shade(mir::Scene& scene, std::uint32_t material, mir::Vec3 corner, float width,
                 float height) {
    const mir::Vec3 x(width, 0, 0);
    const mir::Vec3 z(0, 0, width);
    const mir::Vec3 up(0, height, 0);
    scene.place(mir::builtin::quad("shade", material, corner, x, up));
    scene.place(mir::builtin::quad("shade", material, corner + z, x, up));
    scene.place(mir::builtin::quad("shade", material, corner, z, up));
    scene.place(mir::builtin::quad("shade", material, corner + x, z, up));
}

/// The Cornell box lit by two lamps inside of shades, which let light out above and below.
mir::Scene lamps_in_shades() {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    scene.meshes.pop_back();
    scene.instances.pop_back();
    const auto paper = scene.add(mir::lambertian("paper", {0.8f, 0.75f, 0.6f}));
    const auto bulb = scene.add(mir::emitter("bulb", {}, {40, 36, 30}));
    for (const mir::Vec3 at : {mir::Vec3(-0.8f, 1.2f, 0.2f), mir::Vec3(0.4f, 1.4f, -0.6f)}) {
        place_shade(scene, paper, at, 0.35f, 0.3f);
        const mir::Vec3 corner = at + mir::Vec3(0.125f, 0.15f, 0.125f);
        scene.place(
            mir::builtin::box("bulb", bulb, corner, {0.1f, 0, 0}, {0, 0.1f, 0}, {0, 0, 0.1f}));
    }
    return scene;
}

/// The Cornell box full of boxes without thickness and without a lid.
mir::Scene thin_boxes() {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    const auto card = scene.add(mir::lambertian("card", {0.7f, 0.5f, 0.3f}));
    for (int i = 0; i < 3; ++i) {
        const float x = -0.85f + 0.6f * static_cast<float>(i);
        place_shade(scene, card, {x, 0.05f, 0.5f}, 0.4f, 0.4f);
        scene.place(
            mir::builtin::quad("bottom", card, {x, 0.05f, 0.9f}, {0.4f, 0, 0}, {0, 0, -0.4f}));
    }
    return scene;
}

/// The Cornell box with a floor of rough metal, glTF's default material.
mir::Scene metal_floor() {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    mir::Material metal = mir::lambertian("metal", {1, 1, 1});
    metal.metallic = metal.roughness = metal.specular = 1.0f;
    scene.meshes[0].material = scene.add(metal);
    return scene;
}

/// The Cornell box with colours at its vertices.
mir::Scene coloured_vertices() {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    for (mir::Mesh& m : scene.meshes) {
        if (scene.materials[m.material].emits()) continue;
        for (const mir::Vec3 p : m.positions)
            m.colors.push_back({p.y > 1.0f ? 0.1f : 1.0f, 0.5f, p.x > 0.0f ? 1.0f : 0.2f});
    }
    return scene;
}

/// The Cornell box with a lamp that shines upwards from a board three centimetres below the
/// ceiling: all light comes out of the gap.
mir::Scene lamp_at_ceiling() {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    const std::uint32_t white = scene.meshes.front().material;
    scene.meshes.pop_back();
    scene.instances.pop_back();
    const auto lamp = scene.add(mir::emitter("tube", {0.8f, 0.8f, 0.8f}, {40, 40, 40}));
    const mir::Vec3 corner(-0.2f, 1.97f, 0.2f);
    scene.place(mir::builtin::quad("tube", lamp, corner, {0.4f, 0, 0}, {0, 0, -0.4f}));
    scene.place(mir::builtin::quad("board", white, corner - mir::Vec3(0, 0.01f, 0.4f), {0.4f, 0, 0},
                                   {0, 0, 0.4f}));
    return scene;
}

/// Indirect light by discs less that of paths, relative to it, at the luxels of seeds 1 to 6.
mirtest::Moments indirect_differences(const mir::Scene& scene, RenderSettings s, RenderSettings p) {
    std::array<double, 6> differences{};
    double light = 0.0;
    for (s.seed = p.seed = 1; s.seed <= 6; p.seed = ++s.seed) {
        const double truth = mean_luminance(mirtest::render(scene, p).indirect);
        differences[s.seed - 1] = mean_luminance(mirtest::render(scene, s).indirect) - truth;
        light += truth / 6.0;
    }
    mirtest::Moments relative;
    for (const double d : differences) relative.add(d / light);
    return relative;
}

}  // namespace

// Within 3 % of the path tracer's mean and 3 standard errors of the difference.
TEST_CASE("light gathered by rays to the triangles is that of the path tracer", "[statistical]") {
    RenderSettings s = micro_settings(16);
    s.bounce_layers = false;
    s.luxels_per_pixel = 4;
    s.micro.gather.rays = 64;
    RenderSettings p = path_settings(16);
    p.bounce_layers = false;
    p.luxels_per_pixel = 4;
    p.path.samples = 64;
    for (const mir::Scene& scene :
         {lamps_in_shades(), thin_boxes(), metal_floor(), coloured_vertices(), lamp_at_ceiling()}) {
        const mirtest::Moments off = indirect_differences(scene, s, p);
        CAPTURE(scene.materials.size(), off.mean(), off.standard_error());
        CHECK(std::fabs(off.mean()) < 0.03 + 3.0 * off.standard_error());
    }
}

TEST_CASE("gathered bounces of both Cornell boxes are those of the path tracer") {
    const auto luxels =
        GENERATE(mir::MicroGather::exact, mir::MicroGather::rays, mir::MicroGather::buffers);
    const auto lamp = GENERATE(mir::builtin::Lamp::down, mir::builtin::Lamp::up);
    const mir::Scene scene = mir::builtin::cornell_box(lamp);
    RenderSettings s = micro_settings(16);
    RenderSettings p = path_settings(16);
    s.max_bounce = p.max_bounce = 4;
    s.micro.luxels = luxels;
    const RenderResult discs = mirtest::render(scene, s);
    const RenderResult paths = mirtest::render(scene, p);
    REQUIRE(discs.bounces.size() == 4);
    CHECK(mirtest::relative_difference(discs.emission, paths.emission) < 1e-5);
    CHECK(mirtest::same_bits(discs.bounces[0], discs.direct));
    // Rims of nodes where rays stop hide some of what is behind them, at each bounce.
    const bool exact = luxels == mir::MicroGather::exact;
    const std::array least = exact ? std::array{0.98, 0.97, 0.96} : std::array{0.94, 0.92, 0.89};
    for (std::size_t b = 1; b < 4; ++b) {
        INFO("bounce " << b + 1);
        const double ratio = mean_luminance(discs.bounces[b]) / mean_luminance(paths.bounces[b]);
        CHECK(ratio > least[b - 1]);
        CHECK(ratio < (exact ? 1.02 : 1.03));
        CHECK(worst_tile(discs.bounces[b], paths.bounces[b]) < 0.3);
    }
}

TEST_CASE("one bounce is that of the path tracer but where rays stop early") {
    const mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::up);
    RenderSettings s = micro_settings(16);
    RenderSettings p = path_settings(16);
    s.micro.luxels = mir::MicroGather::rays;
    s.max_bounce = p.max_bounce = 2;
    const double truth = mean_luminance(mirtest::render(scene, p).bounces[1]);
    const auto bias = [&](float threshold) {
        s.micro.gather.threshold = threshold;
        return std::fabs(mean_luminance(mirtest::render(scene, s).bounces[1]) / truth - 1.0);
    };
    const double exact = bias(0.0f);
    CHECK(exact < 0.02);
    CHECK(exact < 0.5 * bias(16.0f));
}

// Rays that stop at large nodes lose a tenth of the light. It is found within 3 standard errors of
// the check and of the picture of paths, and most of it is brought back.
TEST_CASE("a render measures how far the light of its discs lies from that of paths",
          "[statistical]") {
    const mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    RenderSettings s = micro_settings(16);
    s.bounce_layers = false;
    s.micro.luxels = mir::MicroGather::rays;
    s.micro.gather.threshold = 64.0f;
    RenderSettings p = path_settings(16);
    p.bounce_layers = false;
    const double truth = mean_luminance(mirtest::render(scene, p).indirect);
    const RenderResult unknown = mirtest::render(scene, s);
    CHECK_FALSE(unknown.statistics.gather_difference);
    s.micro.check = mir::GatherCheck::measure;
    const RenderResult measured = mirtest::render(scene, s);
    CHECK(mirtest::same_bits(measured.beauty, unknown.beauty));
    REQUIRE(measured.statistics.gather_difference);
    const mir::LightDifference difference = *measured.statistics.gather_difference;
    const double off = mean_luminance(measured.indirect) / truth - 1.0;
    CAPTURE(difference.mean, difference.standard_error, difference.spread, off);
    CHECK(off < -0.05);
    CHECK(std::fabs(difference.mean - off) < 3.0 * difference.standard_error + 0.02);
    CHECK(difference.spread > std::fabs(difference.mean));
    CHECK_FALSE(measured.statistics.gather_corrected);
    REQUIRE(measured.warnings.size() == 1);
    CHECK(measured.warnings[0].find("too dark") != std::string::npos);
    s.micro.check = mir::GatherCheck::correct;
    const RenderResult corrected = mirtest::render(scene, s);
    CHECK(corrected.statistics.gather_corrected);
    CHECK(corrected.warnings.empty());
    CHECK(std::fabs(mean_luminance(corrected.indirect) / truth - 1.0) < 0.025);
}

TEST_CASE("light gathered from discs does not depend on threads, tiles or layers") {
    const mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    RenderSettings s = micro_settings(16);
    s.micro.check = mir::GatherCheck::correct;
    s.micro.luxels = GENERATE(mir::MicroGather::exact, mir::MicroGather::rays);
    s.micro.surfels = 1024;
    s.max_bounce = 3;
    const RenderResult usual = mirtest::render(scene, s);
    s.threads = 1;
    s.tile = {};
    CHECK(mirtest::same_bits(mirtest::render(scene, s).beauty, usual.beauty));
    s.bounce_layers = false;
    const RenderResult sum = mirtest::render(scene, s);
    CHECK(sum.bounces.empty());
    CHECK(mirtest::relative_difference(usual.indirect, sum.indirect) < 1e-5);
    s.bounce_layers = true;
    mir::Monitor monitor;
    CHECK(mirtest::same_bits(mirtest::render(scene, s, &monitor).beauty, usual.beauty));
    // Bounces 2 and 3 of the luxels, and the places of the check.
    CHECK(monitor.planned_gathers == 2 * 16 * 16 + 46 * 45);
    CHECK(monitor.gathers == monitor.planned_gathers);
}

TEST_CASE("one reflection is direct light, and black scenes are black") {
    RenderSettings s = micro_settings(8);
    s.max_bounce = 1;
    const RenderResult r = mirtest::render(mir::builtin::cornell_box(mir::builtin::Lamp::down), s);
    CHECK(mean_luminance(r.indirect) == 0.0);
    CHECK(mean_luminance(r.direct) > 0.0);
    mir::Scene dark = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    for (mir::Material& m : dark.materials) m.emission = {};
    s.max_bounce = 32;
    s.allow_no_light = true;
    CHECK(mean_luminance(mirtest::render(dark, s).beauty) == 0.0);
}

TEST_CASE("settings of discs that make no sense are refused") {
    const mir::Scene scene = mir::builtin::furnace_box();
    RenderSettings s = micro_settings(8);
    SECTION("no disc") { s.micro.surfels = 0; }
    SECTION("too many") { s.micro.surfels = 20'000'000; }
    SECTION("no ray of a disc") { s.micro.surfel_rays = 0; }
    SECTION("no ray of a luxel") { s.micro.gather.rays = 0; }
    SECTION("a bound") { s.bound = {mir::BoundPolicy::Kind::fixed, 1.0f}; }
    CHECK_THROWS_AS(mirtest::render(scene, s), mir::Error);
}
