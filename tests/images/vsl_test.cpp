// SPDX-License-Identifier: MIT
//
// Pictures by virtual spherical lights: the light of the path tracer once spheres are small, spread
// but not lost while they are large, the same bits however the work is cut.
#include "bounce_means.hpp"
#include "however_cut.hpp"
#include "mir/film/moved_luxel.hpp"
#include "mir/runtime/progressive_render.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::SamplerKind;

namespace {

constexpr std::uint32_t runs = 16;
constexpr std::uint32_t side = 24;  // pixels of one luxel

mir::RenderSettings spheres(float scale) {
    mir::RenderSettings s = small_settings(side, 256);
    s.sampler = SamplerKind::instant_radiosity;
    s.direct_samples = 1;
    s.max_bounce = BounceMeans::last_bounce;
    s.vsl = {true, 4, scale};
    return s;
}

BounceMeans rendered(const mir::Scene& scene, mir::RenderSettings s) {
    BounceMeans means;
    s.bounce_layers = true;
    for (s.seed = 0; s.seed < runs; ++s.seed) means.add(render(scene, s));
    return means;
}

}  // namespace

// H0: equal means of D_2 .. D_5 and of their sum, in 9 tiles and over the image. Welch's test over
// 16 replicates each, seeds 0 to 15, path tracer 911, level 1 % over 2 radii; large ones are
// rejected.
TEST_CASE("small spheres bring the light of the path tracer, large ones blur it", "[statistical]") {
    const mir::Scene scene = mir::builtin::make("corner");
    const Studio<mir::Lambert> studio(scene);
    mir::ReferenceOptions options;
    options.samples = 64;
    BounceMeans truth;
    for (const mir::ReferenceImage& image :
         replicates(studio.tracer({.max_bounce = BounceMeans::last_bounce}), studio.rays(side, 911),
                    options, runs))
        truth.add(image);
    CHECK(agreement(rendered(scene, spheres(0.02f)), truth) > sidak(0.01, 2));
    CHECK(agreement(rendered(scene, spheres(0.2f)), truth) > sidak(0.01, 2));
    CHECK(agreement(rendered(scene, spheres(6.0f)), truth) < sidak(0.01, 2));
}

// The VPLs of equal seeds are equal, so that what differs is what spheres do alone.
TEST_CASE("what spheres change of a picture falls with their radius") {
    const mir::Scene scene = mir::builtin::make("corner");
    mir::RenderSettings points = spheres(1.0f);
    points.vsl.enabled = false;
    const auto by_points = render(scene, points).indirect;
    double last = 1e9;
    for (const float scale : {4.0f, 1.0f, 0.25f, 0.0625f}) {
        const double change =
            relative_difference(by_points, render(scene, spheres(scale)).indirect);
        CAPTURE(scale, change);
        CHECK(change < 0.6 * last);
        CHECK(change > 0.0);
        last = change;
    }
    CHECK(last < 0.02);
}

TEST_CASE("threads, tiles, scheduler and stored visibility change no bit of the light of spheres") {
    mir::Scene scene = mir::builtin::make("cornell-box");
    for (mir::Material& m : scene.materials) m.specular = 1.0f;  // the full shading model
    for (mir::Material& m : scene.materials) m.roughness = 0.4f;
    mir::RenderSettings s = spheres(1.0f);
    s.sampler = GENERATE(SamplerKind::instant_radiosity, SamplerKind::metropolis);
    check_light_however_cut(scene, s);
}

TEST_CASE("ray engines of this library give spheres the same light") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    mir::RenderSettings s = spheres(1.0f);
    s.acceleration = mir::Acceleration::kd_tree;
    const mir::RenderResult tree = render(scene, s);
    s.acceleration = mir::Acceleration::bvh;
    CHECK(same_bits(render(scene, s).indirect, tree.indirect));
}

TEST_CASE("spheres remove nothing, add up by bounces and leave direct light alone") {
    const mir::Scene scene = mir::builtin::make("corner");
    mir::RenderSettings s = spheres(1.0f);
    s.bound = {mir::BoundPolicy::Kind::fixed, 0.5f};
    s.bounce_layers = true;
    const mir::RenderResult r = render(scene, s);
    CHECK(r.statistics.removed_luminance == 0.0);
    CHECK(r.statistics.vsl_radius > 0.01);
    CHECK(r.statistics.vsl_radius < 1.0);
    double bounces = 0.0;
    for (const auto& layer : r.bounces) bounces += mean_luminance(layer);
    CHECK(mean_luminance(r.indirect) == Approx(bounces).epsilon(1e-6));
    CHECK(mean_luminance(r.indirect) == Approx(r.statistics.indirect_luminance).epsilon(1e-6));
    s.vsl.enabled = false;
    const mir::RenderResult points = render(scene, s);
    CHECK(points.statistics.vsl_radius == 0.0);
    CHECK(points.statistics.removed_luminance > 0.0);
    CHECK(same_bits(points.direct, r.direct));
}

TEST_CASE("spheres shrink from pass to pass") {
    const mir::Scene scene = mir::builtin::make("corner");
    mir::RenderSettings s = spheres(2.0f);
    mir::Registry registry;
    mir::add_cpu_to(registry);
    const auto renderer = registry.make(s.backend, s.scheduler);
    mir::ProgressiveRender passes(*renderer, scene, s, {.passes = 3});
    mir::Image<mir::Rgb> mean(s.image);
    for (std::uint32_t pass = 0; pass < 3; ++pass) {
        passes.next_pass();
        mir::RenderSettings own = s;
        own.seed = mir::pass_seed(s.seed, pass);
        const mir::Vec2 place = mir::moved_luxel({0.5f, 0.5f}, pass);
        own.only_luxel = {place.x, place.y};
        own.vsl.scale *= static_cast<float>(mir::vsl_radius_share(pass));
        const auto image = render(scene, own).indirect;
        for (std::size_t i = 0; i < mean.pixels().size(); ++i)
            mean.pixels()[i] += (1.0f / 3.0f) * image.pixels()[i];
    }
    CHECK(relative_difference(passes.result().indirect, mean) < 1e-6);
}

TEST_CASE("settings that do not go with spheres are refused") {
    const auto refused = [](auto change) {
        mir::RenderSettings s;
        s.vsl.enabled = true;
        CHECK_NOTHROW(s.validate());
        change(s);
        CHECK_THROWS_AS(s.validate(), mir::Error);
        s.vsl.enabled = false;
        CHECK_NOTHROW(s.validate());
    };
    refused([](mir::RenderSettings& s) { s.vsl.samples = 0; });
    refused([](mir::RenderSettings& s) { s.vsl.samples = 1025; });
    refused([](mir::RenderSettings& s) { s.vsl.scale = 0.0f; });
    refused([](mir::RenderSettings& s) { s.vsl.scale = INFINITY; });
    refused([](mir::RenderSettings& s) { s.integrator = mir::Integrator::path; });
    refused([](mir::RenderSettings& s) { s.direct = mir::DirectLight::vpl; });
    refused([](mir::RenderSettings& s) { s.compensate = 1; });
    refused([](mir::RenderSettings& s) { s.removed_layer = true; });
}
