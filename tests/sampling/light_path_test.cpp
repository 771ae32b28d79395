// SPDX-License-Identifier: MIT
#include "mir/sampling/light_path.hpp"

#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"

using mir::Lambert;
using mir::Rgb;
using mir::Vec3;

namespace {

const Rgb power{2, 3, 4};
const Rgb albedo{0.5f, 0.25f, 0.75f};

/// Light that arrives at 60 degrees to the geometric normal, z, and along the shading normal.
mir::Arrival<Lambert> bent() {
    mir::Arrival<Lambert> at;
    at.point.geometric_normal = {0, 0, 1};
    at.point.shading_normal = at.towards_light = {0.8660254f, 0, 0.5f};
    at.power = power;
    return at;
}

void check_close(Rgb a, Rgb b) {
    CHECK(a.r == Approx(b.r).epsilon(1e-5));
    CHECK(a.g == Approx(b.g).epsilon(1e-5));
    CHECK(a.b == Approx(b.b).epsilon(1e-5));
}

}  // namespace

// What a camera path sees: radiance albedo / pi E with E = P / A (wi.ns) / (wi.ng), since P / A is
// the irradiance of the geometric surface. Here it is twice that without shading normal.
TEST_CASE("a bent normal makes a VPL as bright as cameras see its surface") {
    CHECK(bent().shading_normal_factor() == Approx(2.0));
    check_close(reflective_vpl(bent(), albedo).intensity, power * albedo * (2.0f * mir::inv_pi));
    mir::Arrival<Lambert> flat = bent();
    flat.point.shading_normal = flat.point.geometric_normal;
    CHECK(flat.shading_normal_factor() == 1.0f);
    check_close(reflective_vpl(flat, albedo).intensity, power * albedo * mir::inv_pi);
}

TEST_CASE("light from behind the shading normal is not reflected") {
    mir::Arrival<Lambert> at = bent();
    at.point.shading_normal = {-0.8660254f, 0, 0.5f};
    CHECK(at.shading_normal_factor() == 0.0f);
    CHECK(is_black(reflective_vpl(at, albedo).intensity));
}

// Adjoint of f (wo.ns): f (wi.ns) (wo.ng) / (wi.ng), over the density (wo.ns) / pi of a direction.
TEST_CASE("a bent normal weighs the light that goes on by both directions") {
    const auto scattered = [](Vec3 wi) {
        mir::BsdfSample sample;
        sample.wi = wi;
        sample.weight = albedo;
        return scatter(bent(), sample, bent().point.shading_normal).power;
    };
    check_close(scattered({0.8660254f, 0, 0.5f}), power * albedo * (2.0f * 0.5f));
    check_close(scattered({0, 0, 1}), power * albedo * (2.0f * 2.0f));
    CHECK(is_black(scattered({-1, 0, 0.01f})));
    CHECK(is_black(scattered({1, 0, -0.01f})));
}

// f (wi.ns) (wo.ng) / (wi.ng) over (wo.ng) / pi, the density around the geometric normal.
TEST_CASE("drawn around the geometric normal all directions carry the same light on") {
    for (const Vec3 wi : {Vec3(0, 0, 1), Vec3(0.8660254f, 0, 0.5f), Vec3(-0.96f, 0, 0.28f)}) {
        mir::BsdfSample sample;
        sample.wi = wi;
        sample.weight = albedo;
        check_close(scatter(bent(), sample, bent().point.geometric_normal).power,
                    power * albedo * 2.0f);
    }
}
