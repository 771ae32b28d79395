// SPDX-License-Identifier: MIT
#include "mir/shading/vpl_shading.hpp"

#include "mir/concepts/shading.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/material_params.hpp"
#include "support/catch.hpp"
#include "support/quadrature.hpp"

namespace {

using mir::Hit;
using mir::Lambert;
using mir::RemovedByBound;
using mir::Rgb;
using mir::Vec3;
using mir::Vpl;
using mir::VplShading;
using mirtest::Approx;

static_assert(mir::Shading<VplShading<Lambert>>);
static_assert(mir::Shading<VplShading<mir::CookTorrance>>);
static_assert(mir::ReachLimitedShading<RemovedByBound<Lambert>>);
static_assert(!mir::ReachLimitedShading<VplShading<Lambert>>);

const Vec3 up(0, 0, 1);
const Hit ground{{0, 0, 0}, up};

mir::Surface<Lambert::Params> surface(Vec3 normal = up) {
    return {normal, up, {}, {{0.5f, 0.25f, 1.0f}}};
}
Vpl vpl(Vec3 position, Vec3 normal) { return {position, normal, {2.0f, 4.0f, 1.0f}}; }

}  // namespace

TEST_CASE("a VPL straight above adds J rho / pi / d^2") {
    const Rgb l = VplShading<Lambert>{}(ground, surface(), vpl({0, 0, 2}, -up));
    CHECK(l.r == Approx(2.0f * 0.5f / mir::pi / 4));
    CHECK(l.g == Approx(4.0f * 0.25f / mir::pi / 4));
    CHECK(l.b == Approx(1.0f / mir::pi / 4));
}

TEST_CASE("the geometry term is cos cos / d^2 and scales as 1 / length^2") {
    const Vec3 d(3, 0, 4);
    const Vec3 wi = d / 5.0f;
    CHECK(mir::geometry_term(wi, 0.2f, up, -up) == Approx(0.8f * 0.8f / 25));
    CHECK(mir::geometry_term(wi, 0.2f, up, Vec3(-1, 0, 0)) == Approx(0.8f * 0.6f / 25));
    CHECK(mir::geometry_term(wi, 0.02f, up, -up) == Approx(0.8f * 0.8f / 2500));
}

TEST_CASE("nothing comes from below a horizon") {
    const VplShading<Lambert> shade;
    CHECK(is_black(shade(ground, surface(), vpl({0, 0, -1}, up))));  // below the luxel
    CHECK(is_black(shade(ground, surface(), vpl({0, 0, 1}, up))));   // turned away
    CHECK(
        is_black(shade(ground, surface(-up), vpl({0, 0, 1}, -up))));  // shading normal turned away
}

TEST_CASE("the inverse distance has a limit where VPLs are near, none where they are far") {
    const auto at = [](float d) {
        return mir::inverse_distance<mir::FusedRounding>(Vec3(0.0f, 0.0f, -d));
    };
    CHECK(at(0.0f) == 0x1p50f);
    CHECK(at(0x1p-60f) == 0x1p50f);
    CHECK(at(0x1p-50f) == 0x1p50f);
    CHECK(at(0x1p-49f) == 0x1p49f);
    CHECK(at(0x1p63f) == 0x1p-63f);
}

TEMPLATE_TEST_CASE("a VPL that touches a luxel adds nothing", "", Lambert, mir::CookTorrance) {
    const auto params = material_params(mir::Material{}, TestType{});
    const mir::Surface<typename TestType::Params> s{up, up, {}, params};
    for (const Vec3 normal : {-up, up, Vec3(1, 0, 0)}) {
        const Rgb l = VplShading<TestType>{}(ground, s, vpl(ground.position, normal));
        CHECK((l.r == 0.0f && l.g == 0.0f && l.b == 0.0f));
    }
}

TEST_CASE("the bound caps the geometry term and nothing else") {
    const Vpl near = vpl({0, 0, 0.1f}, -up);
    const Rgb bounded = VplShading<Lambert>{10.0f}(ground, surface(), near);
    CHECK(bounded.r == Approx(2.0f * 0.5f / mir::pi * 10));
    const Vpl far = vpl({0, 0, 1}, -up);
    CHECK(VplShading<Lambert>{10.0f}(ground, surface(), far) ==
          VplShading<Lambert>{}(ground, surface(), far));
}

TEMPLATE_TEST_CASE("what the bound removes completes what it leaves", "", Lambert,
                   mir::CookTorrance) {
    mir::Material m;
    m.roughness = 0.4f;
    const mir::Surface<typename TestType::Params> s{
        up, mirtest::direction(0.6, 1.0), {}, mir::material_params(m, TestType{})};
    for (float height : {0.05f, 0.3f, 1.0f, 3.0f})
        for (float bound : {0.5f, 4.0f, 100.0f}) {
            const Vpl v = vpl({0.2f * height, 0, height}, -up);
            const Rgb whole = VplShading<TestType>{}(ground, s, v);
            const Rgb left = VplShading<TestType>{bound}(ground, s, v);
            const Rgb removed = RemovedByBound<TestType>{bound}(ground, s, v);
            CHECK(left.r + removed.r == Approx(whole.r));
            CHECK(left.b + removed.b == Approx(whole.b));
            CHECK(removed.g >= 0.0f);
        }
}

TEST_CASE("nothing is removed beyond the reach") {
    const RemovedByBound<Lambert> removed{4.0f};
    CHECK(removed.reach_squared() == 0.25f);
    CHECK(is_black(removed(ground, surface(), vpl({0, 0, 0.5001f}, -up))));
    CHECK_FALSE(is_black(removed(ground, surface(), vpl({0, 0, 0.4999f}, -up))));
    CHECK(is_black(RemovedByBound<Lambert>{}(ground, surface(), vpl({0, 0, 1e-3f}, -up))));
}

TEST_CASE("a VPL lights a wide plane with all its power, J pi") {
    // Irradiance by the kernel with rho = pi, summed over rings of the plane z = 0.
    const VplShading<Lambert> shade;
    const Vpl v{{0, 0, 1}, glm::normalize(Vec3(0, 0, -1)), {1, 1, 1}};
    const mir::Surface<Lambert::Params> s{up, up, {}, {{mir::pi, mir::pi, mir::pi}}};
    const double power = mirtest::integrate(0.0, 1.0, 64, [&](double q) {
        const double r = q / (1 - q);  // all radii
        const Hit hit{{static_cast<float>(r), 0, 0}, up};
        return 2 * mirtest::pi * r * static_cast<double>(shade(hit, s, v).r) / ((1 - q) * (1 - q));
    });
    CHECK(power == Approx(mirtest::pi).epsilon(1e-4));
}

TEST_CASE("scaling the scene by s scales a contribution by 1 / s^2") {
    const VplShading<Lambert> shade;
    const Rgb one = shade(ground, surface(), vpl({0.3f, 0.1f, 1}, -up));
    for (float s : {1e-3f, 1e3f}) {
        const Rgb scaled = shade(ground, surface(), vpl(s * Vec3(0.3f, 0.1f, 1), -up));
        CHECK(scaled.r * s * s == Approx(one.r).epsilon(1e-5));
    }
}
