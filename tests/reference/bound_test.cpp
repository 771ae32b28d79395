// SPDX-License-Identifier: MIT
//
// The bound of the geometry term: what the path tracer keeps is what VplShading keeps.
#include "mir/scene/builtin.hpp"
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
    [[nodiscard]] std::vector<mir::RgbSum> radiance(float bound) const {
        using Tracer = mir::PathTracer<Lambert, AnalyticSphere, FreeSight>;
        const Tracer tracer({geometry, lights, surfaces, AnalyticSphere{2.0f}, FreeSight{}},
                            {.max_bounce = last, .roulette_from = 255, .bound = bound});
        std::vector<mir::RgbSum> bounces(last + 1);
        mir::Random random(1, mir::Stream::reference, 0);
        tracer.trace(*tracer.first_vertex({{0, 0, 0}, {0.6f, 0, 0.8f}}), random, bounces);
        return bounces;
    }
};

}  // namespace

TEST_CASE("a bound takes its share of all light that is scattered twice, and of no other") {
    const Sphere sphere;
    const auto free = sphere.radiance(std::numeric_limits<float>::max());
    for (const float share : {0.01f, 0.3f, 0.999f}) {
        const auto bounded = sphere.radiance(share * sphere.geometry_term());
        CHECK(bounded[1].channel == free[1].channel);
        for (std::size_t b = 2; b <= last; ++b)
            CHECK(bounded[b].channel[0] ==
                  Approx(static_cast<double>(share) * free[b].channel[0]).epsilon(1e-5));
    }
    CHECK(sphere.radiance(1.001f * sphere.geometry_term())[last].channel == free[last].channel);
}
