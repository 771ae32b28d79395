// SPDX-License-Identifier: MIT
#include "mir/paths/path_measure.hpp"

#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/path_lab.hpp"
#include "support/wedge.hpp"

#include <cmath>

// The measure of a path written out term by term, once per length and with no loop or table, for
// paths between tilted surfaces of which no two cosines are alike.

namespace {

using mir::CookTorrance;
using mir::Lambert;
using mir::LightOrigin;
using mir::Path;
using mir::PathMeasure;
using mir::PathTechniques;
using mir::PathVertex;
using mir::Rgb;
using mir::Vec3;
using mirtest::Approx;
using mirtest::PathLab;
using mirtest::Wedge;
using mirtest::WedgeLights;
using DVec3 = glm::dvec3;

double length2(DVec3 v) { return glm::dot(v, v); }
DVec3 towards(Vec3 from, Vec3 to) { return glm::normalize(DVec3(to) - DVec3(from)); }

/// cos cos / d^2 from a receiver, by its shading normal, to a sender, by its geometric one.
double geometry(const PathVertex& receiver, const PathVertex& sender) {
    const DVec3 w = towards(receiver.position, sender.position);
    return glm::dot(w, DVec3(receiver.shading_normal)) * -glm::dot(w, DVec3(sender.normal)) /
           length2(DVec3(sender.position) - DVec3(receiver.position));
}

template <class World>
Rgb bsdf(const World& world, const PathVertex& at, Vec3 to_light, Vec3 to_eye) {
    return World::Bsdf::eval(world.params(at), at.shading_normal,
                             Vec3(towards(at.position, to_light)),
                             Vec3(towards(at.position, to_eye)));
}

/// What x2 makes of light from x3, whichever way it leaves.
template <class World>
Rgb spread(const World& world, const Path& path) {
    const Vec3 to_light(towards(path.x(2).position, path.x(3).position));
    const auto sample =
        World::Bsdf::sample(world.params(path.x(2)), path.x(2).shading_normal, to_light,
                            {path.spread.x, path.spread.y}, path.spread.z);
    return sample.weight * mir::inv_pi;
}

template <class World>
Rgb first_bsdf(const World& world, const Path& path) {
    return bsdf(world, path.x(1), path.x(2).position, path.eye);
}

Rgb scaled(Rgb c, double by) { return c * static_cast<float>(by); }

/// R of paths of two, three and four edges that end on a lamp.
template <class World>
Rgb leaving(const World& world, const Path& path) {
    const Rgb light = path.light.emission;
    const auto term = [&](std::uint32_t i) {
        return world.area_unit * geometry(path.x(i), path.x(i + 1));
    };
    if (path.edges() == 2) return light;
    if (path.edges() == 3) return scaled(light * spread(world, path), term(2));
    const Rgb third = bsdf(world, path.x(3), path.x(4).position, path.x(2).position);
    return scaled(light * third * spread(world, path), term(2) * term(3));
}

void check_equal(const mir::WideRgb& a, const mir::WideRgb& b) {
    REQUIRE(a.r == Approx(b.r).epsilon(1e-4));
    REQUIRE(a.g == Approx(b.g).epsilon(1e-4));
    REQUIRE(a.b == Approx(b.b).epsilon(1e-4));
}

/// Whether a cosine is so small that single precision spoils it.
bool is_grazing(const Path& path) {
    for (std::uint32_t i = 1; i < path.edges(); ++i) {
        if (i + 1 == path.edges() && path.light.origin != LightOrigin::surface) return false;
        const DVec3 w = towards(path.x(i).position, path.x(i + 1).position);
        for (Vec3 n : {path.x(i).normal, path.x(i).shading_normal, path.x(i + 1).normal})
            if (std::fabs(glm::dot(w, DVec3(n))) < 0.01) return true;
    }
    return false;
}

/// Calls f(path, measure) for some hundred paths of k edges along which light passes.
template <class World, class F>
void for_each_path(const World& world, std::uint32_t k, const F& f) {
    int found = 0;
    for (std::uint64_t i = 0; i < 20'000 && found < 300; ++i) {
        const mir::Random u(3, mir::Stream::test, i);
        Path path;
        PathMeasure m;
        const auto s = static_cast<std::uint32_t>(i) % k;
        if (!mirtest::build_by(world, {k, s}, u, path) || !measure_path(world, path, m)) continue;
        if (is_grazing(path)) continue;
        ++found;
        f(path, m);
    }
    REQUIRE(found > 100);
}

/// cos / (pi d^2): density per area of `to` of a cosine-distributed direction at `from`.
double cosine_density(const PathVertex& from, const PathVertex& to, Vec3 about) {
    const DVec3 w = towards(from.position, to.position);
    return glm::dot(w, DVec3(about)) * -glm::dot(w, DVec3(to.normal)) / mirtest::pi /
           length2(DVec3(to.position) - DVec3(from.position));
}

}  // namespace

TEMPLATE_TEST_CASE("the contribution of short paths is the product of its terms", "", Lambert,
                   CookTorrance) {
    const auto lights = GENERATE(WedgeLights::ceiling, WedgeLights::two_sided);
    const PathLab<TestType> lab(Wedge(lights, std::is_same_v<TestType, Lambert> ? 0 : 1).scene());
    const auto world = lab.world();
    for (std::uint32_t k = 2; k <= 4; ++k)
        for_each_path(world, k, [&](const Path& path, const PathMeasure& m) {
            const Rgb r = leaving(world, path);
            check_equal(m.leaving, r);
            check_equal(m.contribution,
                        scaled(first_bsdf(world, path) * r, geometry(path.x(1), path.x(2))));
        });
}

TEST_CASE("a geometry term with the normals of its ends exchanged would be noticed") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::ceiling).scene());
    double largest = 0.0;
    for_each_path(lab.world(), 3, [&](const Path& path, const PathMeasure& m) {
        const double wrong = geometry(path.x(3), path.x(2)) / geometry(path.x(2), path.x(3));
        const Rgb r = scaled(leaving(lab.world(), path), wrong);
        largest = std::max(largest, std::fabs(static_cast<double>(r.g) / m.leaving.g - 1.0));
    });
    CHECK(largest > 0.05);
}

TEST_CASE("light from a point, a spot and the sun arrives as I cos / d^2 or E cos") {
    const auto lights = GENERATE(WedgeLights::point, WedgeLights::spot, WedgeLights::directional);
    const PathLab<Lambert> lab(Wedge(lights).scene());
    const auto world = lab.world();
    for_each_path(world, 3, [&](const Path& path, const PathMeasure& m) {
        const PathVertex& x2 = path.x(2);
        DVec3 w = -DVec3(Vec3(-1, -0.7f, 0.1f)) / std::sqrt(1.5);
        double light = 1.0;
        if (lights != WedgeLights::directional) {
            w = towards(x2.position, path.x(3).position);
            light = 1.0 / length2(DVec3(path.x(3).position) - DVec3(x2.position));
        }
        if (lights == WedgeLights::spot) {
            const mir::SpotLight& spot = lab.scene.spot_lights[0];
            light *= static_cast<double>(source_of(spot, {}).share(spot.direction, Vec3(-w)));
        }
        light *= glm::dot(w, DVec3(x2.shading_normal));
        if (light < 1e-3) return;
        check_equal(m.leaving, scaled(Rgb{3, 2, 1} * spread(world, path), light));
    });
}

TEST_CASE("the bounded kernel caps the term of x1 and x2 and no other") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::ceiling).scene());
    int capped = 0;
    for (std::uint32_t k = 2; k <= 4; ++k)
        for_each_path(lab.world(), k, [&](const Path& path, const PathMeasure& free) {
            PathMeasure m;
            REQUIRE(measure_path(lab.world(0.5f), path, m));
            const double g = geometry(path.x(1), path.x(2));
            const double share = g > 0.5 ? 0.5 / g : 1.0;
            capped += g > 0.5 ? 1 : 0;
            check_equal(m.contribution, free.contribution * share);
            check_equal(m.leaving, free.leaving);
        });
    CHECK(capped > 50);
}

TEST_CASE("between Lambertian surfaces a vertex has the density cos cos / (pi d^2)") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::two_sided).scene());
    const double unit = lab.world().area_unit;
    for_each_path(lab.world(), 4, [&](const Path& path, const PathMeasure& m) {
        REQUIRE(m.area_unit == unit);
        for (std::uint32_t i = 2; i <= 4; ++i)
            REQUIRE(m.from_eye[i] ==
                    Approx((i > 2 ? unit : 1.0) *
                           cosine_density(path.x(i - 1), path.x(i), path.x(i - 1).shading_normal)));
        REQUIRE(m.from_light[2] ==
                Approx(cosine_density(path.x(3), path.x(2), path.x(3).shading_normal)));
        // Lamps send light about their geometric normal.
        REQUIRE(m.from_light[3] ==
                Approx(unit * cosine_density(path.x(4), path.x(3), path.x(4).normal)));
    });
}

TEST_CASE("glossy vertices are drawn from their lobe, but x3 as a VPL's light is") {
    const PathLab<CookTorrance> lab(Wedge(WedgeLights::two_sided, 1.0f).scene());
    const auto world = lab.world();
    const auto lobe = [&](const PathVertex& at, Vec3 before, const PathVertex& to) {
        const DVec3 w = towards(at.position, to.position);
        const float pdf = CookTorrance::pdf(world.params(at), at.shading_normal, Vec3(w),
                                            Vec3(towards(at.position, before)));
        return static_cast<double>(pdf) * -glm::dot(w, DVec3(to.normal)) /
               length2(DVec3(to.position) - DVec3(at.position));
    };
    for_each_path(world, 4, [&](const Path& path, const PathMeasure& m) {
        REQUIRE(m.from_eye[2] == Approx(lobe(path.x(1), path.eye, path.x(2))).epsilon(1e-3));
        if (!world.luxels.surfaces.is_lambertian(path.x(2).material))
            REQUIRE(m.from_eye[3] ==
                    Approx(world.area_unit *
                           cosine_density(path.x(2), path.x(3), path.x(2).shading_normal)));
        REQUIRE(
            m.from_eye[4] ==
            Approx(world.area_unit * lobe(path.x(3), path.x(2).position, path.x(4))).epsilon(1e-3));
        REQUIRE(m.from_light[2] ==
                Approx(lobe(path.x(3), path.x(4).position, path.x(2))).epsilon(1e-3));
    });
}

TEST_CASE("light paths from lights without extent have the density of their first ray") {
    const auto lights = GENERATE(WedgeLights::point, WedgeLights::spot, WedgeLights::directional);
    const PathLab<Lambert> lab(Wedge(lights).scene());
    const double radius = 0.5 * static_cast<double>(lab.geometry.bounds().diagonal());
    const double cone = 2 * mirtest::pi * (1 - std::sqrt(0.5));
    for_each_path(lab.world(), 3, [&](const Path& path, const PathMeasure& m) {
        const PathVertex& x2 = path.x(2);
        double expected = 1.0 / (mirtest::pi * radius * radius);
        DVec3 w = -DVec3(path.x(3).normal);
        if (lights != WedgeLights::directional) {
            w = towards(x2.position, path.x(3).position);
            const double d2 = length2(DVec3(path.x(3).position) - DVec3(x2.position));
            expected = 1.0 / ((lights == WedgeLights::spot ? cone : 4 * mirtest::pi) * d2);
        }
        REQUIRE(m.from_light[2] == Approx(expected * glm::dot(w, DVec3(x2.normal))).epsilon(1e-4));
        REQUIRE(m.from_eye[3] == 0.0);
        REQUIRE(m.next_event == 1.0);
        REQUIRE(m.emission == 1.0);
    });
}

TEST_CASE("paths that are no path VPLs measure nothing") {
    const PathLab<Lambert> delta(Wedge(WedgeLights::point).scene());
    const PathLab<Lambert> lab(Wedge(WedgeLights::ceiling).scene());
    const auto world = lab.world();
    PathMeasure m;
    for (std::uint64_t i = 0; i < 200; ++i) {
        Path path;
        if (mirtest::build_by(delta.world(), {2, 1}, {9, mir::Stream::test, i}, path))
            CHECK_FALSE(measure_path(delta.world(), path, m));
    }
    for_each_path(world, 3, [&](const Path& path, const PathMeasure&) {
        for (std::uint32_t turned = 1; turned <= 3; ++turned) {
            Path other = path;
            other.x(turned).normal = -other.x(turned).normal;
            REQUIRE_FALSE(measure_path(world, other, m));
        }
        Path same_place = path;
        same_place.x(2).position = same_place.x(1).position;
        REQUIRE_FALSE(measure_path(world, same_place, m));
    });
}
