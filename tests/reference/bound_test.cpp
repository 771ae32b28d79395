// SPDX-License-Identifier: MIT
//
// The bound of the geometry term: what the path tracer keeps is what VplShading keeps.
#include "mir/scenes.hpp"
#include "mir/shading/lambert.hpp"
#include "studio.hpp"
#include "support/analytic_sphere.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"

using namespace mirtest;
using mir::Lambert;

namespace {

constexpr std::uint8_t last = 4;

mir::Scene bulb_in_a_box() {
    mir::Scene s;
    const std::uint32_t wall = s.add(mir::lambertian("wall", {0.5f, 0.5f, 0.5f}));
    s.place(mir::builtin::box("box", wall, mir::Vec3(-2), {4, 0, 0}, {0, 4, 0}, {0, 0, 4}));
    s.point_lights.push_back({"bulb", {0, 0, 0}, {3, 3, 3}});
    return s;
}

/// A bulb at the centre of a sphere of 2 m, for whose scale a box stands in. Every pair of its
/// points has the geometry term 1 / (4 R^2), so that no bounce has any variance.
struct Sphere {
    mir::Scene scene = bulb_in_a_box();
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<Lambert> surfaces{scene};

    /// Of lifted points, m^-2.
    [[nodiscard]] float geometry_term() const {
        const float lifted = 2.0f - geometry.ray_offset();
        return 1.0f / (4.0f * lifted * lifted);
    }
    /// D_0 .. D_last of one path.
    [[nodiscard]] std::vector<mir::RgbSum> radiance(
        float bound, mir::BoundPart part = mir::BoundPart::kept) const {
        using Tracer = mir::PathTracer<Lambert, AnalyticSphere, FreeSight>;
        const Tracer tracer(
            {geometry, lights, surfaces, AnalyticSphere{2.0f}, FreeSight{}},
            {.max_bounce = last, .roulette_from = 255, .bound = bound, .part = part});
        std::vector<mir::RgbSum> bounces(last + 1);
        mir::Random random(1, mir::Stream::reference, 0);
        tracer.trace(tracer.luxel({{0, 0, 0}, {0.6f, 0, 0.8f}}), random, bounces);
        return bounces;
    }
};

}  // namespace

TEST_CASE("a bound takes its share of all light that is scattered twice, and of no other") {
    const Sphere sphere;
    const auto free = sphere.radiance(std::numeric_limits<float>::max());
    for (const float share : {0.01f, 0.3f, 0.999f}) {
        const auto bounded = sphere.radiance(share * sphere.geometry_term());
        CHECK(bounded[1] == free[1]);
        for (std::size_t b = 2; b <= last; ++b)
            CHECK(bounded[b].channel[0] ==
                  Approx(static_cast<double>(share) * free[b].channel[0]).epsilon(1e-5));
    }
    CHECK(sphere.radiance(1.001f * sphere.geometry_term())[last] == free[last]);
}

TEST_CASE("what a bound removes is the rest of that light, and nothing else") {
    const Sphere sphere;
    const auto free = sphere.radiance(std::numeric_limits<float>::max());
    for (const float share : {0.01f, 0.3f, 0.99f}) {
        const auto removed =
            sphere.radiance(share * sphere.geometry_term(), mir::BoundPart::removed);
        for (std::size_t b = 0; b < 2; ++b) CHECK(removed[b] == mir::RgbSum{});
        const double rest = 1.0 - static_cast<double>(share);
        // A small rest is a difference of rounded numbers.
        for (std::size_t b = 2; b <= last; ++b)
            CHECK(removed[b].channel[0] ==
                  Approx(rest * free[b].channel[0]).epsilon(1e-5 + 2e-7 / rest));
    }
    const auto nothing = sphere.radiance(1.001f * sphere.geometry_term(), mir::BoundPart::removed);
    for (const mir::RgbSum& b : nothing) CHECK(b == mir::RgbSum{});
}

TEST_CASE("light across an edge nearer than points are lifted is what no VPL brings") {
    // A floor's point beside a wall at x = 0, both lifted by 1e-3: the wall's lies behind.
    const mir::Hit at{{0.5e-3f, 1e-3f, 0}, {0, 1, 0}};
    const mir::Hit from{{1e-3f, 0.1f, 0}, {1, 0, 0}};
    const mir::BoundSplit kept{5.0f};
    const mir::BoundSplit removed{5.0f, mir::BoundPart::removed};
    CHECK(kept.reflected(at, at.normal, from) == 0.0f);
    CHECK(removed.reflected(at, at.normal, from) == 1.0f);
    CHECK(mir::BoundSplit{}.reflected(at, at.normal, from) == 1.0f);
}

namespace {

/// Mean luminance of D_1 .. D_3 over 16 replicates of the corner whose wall shines too.
std::vector<TileMeans> bounces_of(const Studio<Lambert>& studio, const mir::PathTracerOptions& o) {
    mir::ReferenceOptions options;
    options.samples = 64;
    const auto images = replicates(studio.tracer(o), studio.rays(16, 7), options, 16);
    std::vector<TileMeans> means;
    for (std::uint8_t b = 1; b <= 3; ++b) means.push_back(tiles_of(images, b, 16));
    return means;
}

}  // namespace

// H0: the means of the two parts add up to that of all light, t test with the standard errors of
// all three added up; seed 7, level 1 % over three bounces and three ways to find lamps. The kept
// part alone is rejected.
TEST_CASE("both parts under a bound that holds for lamps add up to all light", "[statistical]") {
    mir::Scene scene = mir::builtin::make("corner");
    scene.materials[1].emission = {1.0f, 0.5f, 0.25f};
    const Studio<Lambert> studio(scene);
    const double level = sidak(0.01, 3 * 3);
    for (const mir::LightSearch search :
         {mir::LightSearch::mis, mir::LightSearch::lamps, mir::LightSearch::directions}) {
        mir::PathTracerOptions o{.light = search, .max_bounce = 3};
        // Other numbers of directions are other random numbers.
        const auto all = bounces_of(studio, o);
        o.bound = 0.5f;
        o.bound_lamps = true;
        o.directions = 2;
        const auto kept = bounces_of(studio, o);
        o.part = mir::BoundPart::removed;
        o.directions = 3;
        const auto removed = bounces_of(studio, o);
        for (std::size_t b = 0; b < 3; ++b) {
            const Moments& a = all[b].moments().front();
            const Moments& k = kept[b].moments().front();
            const Moments& r = removed[b].moments().front();
            const double error = std::hypot(k.standard_error(), r.standard_error());
            CAPTURE(int(search), b + 1, a.mean(), k.mean(), r.mean(), error);
            CHECK(mean_p_value(a, k.mean() + r.mean(), error) > level);
            if (search != mir::LightSearch::directions)  // whose noise hides it
                CHECK(mean_p_value(a, k.mean(), k.standard_error()) < level);
        }
    }
}
