// SPDX-License-Identifier: MIT
//
// Light that goes through a surface diffusely: what it is worth, and where chains end that draw it.
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/core/random.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/shading/luxel_tracer.hpp"
#include "mir/shading/surface_table.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

namespace {

using mir::CookTorrance;
using mir::MaterialFactors;
using mir::Rgb;
using mir::SpecularEvent;
using mir::Vec3;
using mirtest::Approx;

using Surfaces = mir::SurfaceTableView<mir::Space::host, CookTorrance>;

const Vec3 up(0, 0, 1);

/// White on both ways through.
MaterialFactors leaf(float through, float specular, float roughness = 1.0f) {
    MaterialFactors m;
    m.base_color = {1, 1, 1};
    m.specular = specular;
    m.roughness = roughness;
    m.diffuse_transmission = through;
    return m;
}

double albedo(const CookTorrance::Params& p, Vec3 wo) {
    return mirtest::integrate_hemisphere(
        64, [&](Vec3 wi) { return CookTorrance::eval(p, up, wi, wo).g * wi.z; });
}

/// A leaf in the plane y = 0 above which a ray looks down.
struct Plane {
    explicit Plane(mir::Material m) : scene(of(std::move(m))) {}

    static mir::Scene of(mir::Material m) {
        mir::Scene s;
        s.place(mir::builtin::quad("leaf", s.add(std::move(m)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
        return s;
    }
    [[nodiscard]] auto tracer() const {
        return mir::LuxelTracer{tree.ray_caster(), surfaces.view()};
    }

    mir::Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::SurfaceTable<CookTorrance> surfaces{scene};
    mir::KdTreeScene tree{geometry};
};

mir::Material material(float through, Rgb color) {
    mir::Material m = mir::lambertian("leaf", {0.4f, 0.5f, 0.2f});
    m.diffuse_transmission = through;
    m.diffuse_transmission_color = color;
    return m;
}

}  // namespace

TEST_CASE("a white leaf reflects or lets through exactly all light") {
    for (const float through : {0.0f, 0.3f, 1.0f})
        for (const double cosine : {0.05, 0.3, 0.7, 1.0}) {
            CAPTURE(through, cosine);
            const Vec3 wo = mirtest::direction(cosine, 0.0);
            const MaterialFactors plain = leaf(through, 0.0f);
            const double matte = albedo(mir::material_params(plain, CookTorrance{}), wo) +
                                 albedo(Surfaces::through(plain), wo);
            CHECK(matte == Approx(1.0).epsilon(1e-5));
            // A smooth interface: chains carry what it mirrors.
            const MaterialFactors waxed = leaf(through, 1.0f, 0.0f);
            const CookTorrance::Params p = mir::material_params(waxed, CookTorrance{});
            const double below = albedo(CookTorrance::without_lobe(p), wo);
            const double mirrored = double(CookTorrance::schlick(p, float(cosine)).g);
            CHECK(mirrored + below + albedo(Surfaces::through(waxed), wo) ==
                  Approx(1.0).epsilon(1e-3));
            CHECK(albedo(Surfaces::through(waxed), wo) ==
                  Approx(double(through) * (1.0 - mirrored)).margin(1e-3));
        }
}

TEST_CASE("what goes through has its own colour, and metals let nothing through") {
    MaterialFactors m = leaf(0.25f, 0.0f);
    m.diffuse_transmission_color = {0.8f, 0.4f, 0.2f};
    const Rgb f = CookTorrance::eval(Surfaces::through(m), up, up, up) * mir::pi;
    CHECK(f.r == Approx(0.2));
    CHECK(f.g == Approx(0.1));
    CHECK(f.b == Approx(0.05));
    const mir::Lambert::Params plain =
        mir::SurfaceTableView<mir::Space::host, mir::Lambert>::through(m);
    CHECK(plain.reflectance.r == Approx(0.2));
    m.metallic = 1.0f;
    CHECK(CookTorrance::is_black(Surfaces::through(m)));
}

// With `n` on the lit side, wi above it and the viewer below, f is eval(wi, -wo). The other way
// round the normal turns, and so do both directions.
TEST_CASE("diffuse transmission is the same both ways") {
    mir::Random random(941, mir::Stream::test, 0);
    for (int i = 0; i < 2000; ++i) {
        MaterialFactors m = leaf(random.next(), random.next(), random.next());
        m.clearcoat = random.next();
        const CookTorrance::Params p = Surfaces::through(m);
        const Vec3 wi = mir::square_to_cone(random.next_2d(), 0.0f);
        const Vec3 wo = -mir::square_to_cone(random.next_2d(), 0.0f);
        REQUIRE(CookTorrance::eval(p, up, wi, -wo).r ==
                Approx(CookTorrance::eval(p, -up, wo, -wi).r).epsilon(1e-5));
    }
}

TEST_CASE("a chain that goes through ends on the other side, seen from opposite") {
    const Plane plane(material(1.0f, {0.25f, 0.5f, 0.75f}));
    const mir::Ray down{{0.2f, 1, 0.3f}, glm::normalize(Vec3(0.3f, -1, 0.1f))};
    // Of all that it does, the base is black: only light from behind is left.
    const mir::SeenLuxel seen = plane.tracer()(down);
    REQUIRE(seen.is_through);
    CHECK(seen.point.geometric_normal == Vec3(0, -1, 0));
    CHECK_FALSE(seen.point.front);
    CHECK(seen.ray.direction == -down.direction);
    CHECK(seen.ray.origin.y == Approx(-1.0).margin(1e-3));
    CHECK(plane.tracer().hit(seen).position.y < 0.0f);
    CHECK(is_black(seen.light));
    const auto surface = plane.tracer().surface(seen);
    CHECK(surface.normal == Vec3(0, -1, 0));
    CHECK(glm::dot(surface.wo, surface.normal) > 0.0f);
    // What its weight leaves of the colour, whatever the chance of the event was.
    const Rgb f = CookTorrance::eval(surface.bsdf, surface.normal, surface.normal, surface.wo);
    CHECK(f.b == Approx(0.75f * mir::inv_pi).epsilon(1e-5));
}

// H0: both ends together, each over its chance, reflect and let through what the material says.
// 4096 rays of the plane, seed 942, 4.5 standard errors.
TEST_CASE("both ends of a chain are drawn as their weights say", "[statistical]") {
    const Plane plane(material(0.6f, {0.5f, 0.5f, 0.5f}));
    mir::Random random(942, mir::Stream::test, 0);
    mirtest::Moments reflected;
    mirtest::Moments through;
    for (int i = 0; i < 4096; ++i) {
        const mir::Ray ray{{0, 1, 0},
                           glm::normalize(Vec3(random.next() - 0.5f, -1, random.next() - 0.5f))};
        const mir::SeenLuxel seen = plane.tracer()(ray);
        const auto surface = plane.tracer().surface(seen);
        const auto f = double(CookTorrance::albedo(surface.bsdf, surface.normal, surface.wo).g);
        reflected.add(seen.is_through ? 0.0 : f);
        through.add(seen.is_through ? f : 0.0);
    }
    CHECK(through.mean() == Approx(0.3).margin(4.5 * through.standard_error()));
    CHECK(reflected.mean() == Approx(0.2).margin(4.5 * reflected.standard_error()));
    CHECK(through.standard_error() > 0.0);
}

TEST_CASE("the chance to go through is that of the material, and none without") {
    const auto chance = [](const mir::Material& m) {
        const Plane plane(m);
        return plane.surfaces.view().through_chance(0, {});
    };
    CHECK(chance(material(0.0f, {1, 1, 1})) == 0.0f);
    CHECK(chance(material(0.5f, {0, 0, 0})) == 0.0f);
    CHECK(chance(material(1.0f, {1, 1, 1})) == 1.0f);
    mir::Material m = material(0.5f, {0.3f, 0.3f, 0.3f});
    m.base_color = {0.6f, 0.6f, 0.6f};
    CHECK(chance(m) == Approx(1.0 / 3.0));
    // What reflects alike has the mean albedo of both sides together.
    CHECK(Plane(m).surfaces.mean_albedo(0) == Approx(0.45));
    CHECK(Plane(m).surfaces.view().is_specular(0));
    m.diffuse_transmission = 0.0f;
    CHECK_FALSE(Plane(m).surfaces.view().is_specular(0));
}
