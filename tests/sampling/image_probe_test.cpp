// SPDX-License-Identifier: MIT
#include "mir/sampling/image_probe.hpp"

#include "conformance/brute_force.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/analytic_sphere.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"
#include "support/statistics.hpp"

#include <algorithm>
#include <array>

namespace {

using mir::Camera;
using mir::ImageProbe;
using mir::Lambert;
using mir::ProbeRays;
using mir::Rgb;
using mir::Vec3;
using mir::Vpl;
using mirtest::Approx;

/// Sphere of radius 2 seen from its centre, and whatever `keep` lets through.
struct Ball {
    mirtest::AnalyticSphere sphere{2.0f, 0, 0};
    bool right_half_only = false;

    [[nodiscard]] std::optional<mir::SurfacePoint> closest_hit(const mir::Ray& ray) const {
        if (right_half_only && ray.direction.x < 0.0f) return std::nullopt;
        return sphere.closest_hit(ray);
    }
    /// VPL at the place that `u` picks; its intensity is one that a probe must not read.
    [[nodiscard]] Vpl vpl(mir::Vec2 u) const {
        const mir::SurfacePoint p = sphere.point(mir::square_to_sphere(u));
        return {p.position, p.geometric_normal, {9.0f, 9.0f, 9.0f}};
    }
};

mir::SurfaceTable<Lambert> one_material(Rgb reflectance) {
    mir::Scene scene;
    scene.add(mir::lambertian("wall", reflectance));
    return mir::SurfaceTable<Lambert>(scene);
}

/// A wall in the plane z = 0 whose shading normals turn away from who stands before it.
struct WallSeenFromBehindItsNormals {
    [[nodiscard]] std::optional<mir::SurfacePoint> closest_hit(const mir::Ray& ray) const {
        if (!(ray.direction.z < 0.0f)) return std::nullopt;
        mir::SurfacePoint p;
        p.position = ray.origin - ray.direction * (ray.origin.z / ray.direction.z);
        p.geometric_normal = Vec3(0, 0, 1);
        p.shading_normal = glm::normalize(Vec3(1.0f, 0.0f, -0.5f));
        p.front = true;
        return p;
    }
};

/// The Cornell box seen from the side, so that a third of the luxels see nothing.
struct Stage {
    mir::Scene scene = mir::builtin::make("cornell-box");
    mir::WorldGeometry geometry{scene};
    mir::SurfaceTable<Lambert> surfaces{scene};
    mir::cpu::EmbreeScene embree{geometry};
    Camera camera = Camera::look_at({2.0f, 1.5f, 4.5f}, {0.6f, 1.0f, 0.0f}, {0, 1, 0}, 0.6f);

    template <mir::Visibility V>
    [[nodiscard]] ImageProbe<Lambert, V> probe(std::uint64_t seed, V visibility) const {
        return {
            {camera, 1.0f, 256, seed}, embree.ray_caster(), surfaces, visibility, {.bound = 4.0f}};
    }
    /// Mean radiance of an image of 48 x 48 pixels, of 4 luxels each, by the library's first phase.
    [[nodiscard]] double full_response(const Vpl& vpl, std::uint64_t seed) const {
        const mir::CameraRays rays{camera, mir::luxel_grid({48, 48}, 4), seed};
        mir::BlockedGBuffer<Lambert::Params> gbuffer(rays.grid.luxels(), {96, 96});
        mir::InlineExecutor executor;
        mir::fill_gbuffer<Lambert>(gbuffer, 0, rays, embree.ray_caster(), surfaces, executor);
        const auto view = gbuffer.view(0);
        const auto layout = mir::BlockedLayout::of(gbuffer.tiles()[0]);
        const mir::VplShading<Lambert> shading{.bound = 4.0f};
        double sum = 0.0;
        for (std::uint32_t y = 0; y < 96; ++y)
            for (std::uint32_t x = 0; x < 96; ++x) {
                const std::uint32_t at = layout(x, y);
                sum += static_cast<double>(luminance(mir::contribution(
                    view.hit(at), view.surface(at), vpl, embree.visibility(), shading)));
            }
        return sum / (96.0 * 96.0);
    }
};

/// Places on the tall block's top, the ceiling, the red wall and the floor behind the blocks.
const std::array<Vpl, 4> places{{{{-0.4f, 1.201f, -0.3f}, {0, 1, 0}, {1, 1, 1}},
                                 {{0.3f, 1.999f, 0.2f}, {0, -1, 0}, {1, 1, 1}},
                                 {{-0.999f, 0.5f, 0.4f}, {1, 0, 0}, {1, 1, 1}},
                                 {{0.2f, 0.001f, -0.7f}, {0, 1, 0}, {1, 1, 1}}}};

/// Hides the packet interface of a visibility.
struct SingleRays {
    static constexpr mir::Space space = mir::Space::host;
    mirtest::BruteForceVisibility inner;
    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const { return inner.visible(a, b); }
};
static_assert(mir::PacketVisibility<mirtest::BruteForceVisibility>);
static_assert(mir::Visibility<SingleRays> && !mir::PacketVisibility<SingleRays>);

/// p-values, place by place, of "the mean over seeds of `estimate(place, seed)` is that of the full
/// image". Probe seeds run from 1001 on, image seeds from 2001 on.
template <class Estimate>
std::array<double, 4> against_full_image(const Stage& stage, const Estimate& estimate) {
    std::array<double, 4> p{};
    for (std::size_t i = 0; i < places.size(); ++i) {
        mirtest::Moments probes;
        mirtest::Moments images;
        for (std::uint64_t s = 1001; s < 1201; ++s) probes.add(estimate(places[i], s));
        for (std::uint64_t s = 2001; s < 2011; ++s) images.add(stage.full_response(places[i], s));
        p[i] = mirtest::welch_p_value(probes, images);
    }
    return p;
}

}  // namespace

TEST_CASE("inside a sphere every place has the response rho / (4 pi R^2)") {
    const Ball ball;
    const auto surfaces = one_material({0.6f, 0.3f, 0.0f});
    const Camera camera = Camera::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.2f);
    const ImageProbe<Lambert, mirtest::FreeSight> probe({camera, 1.5f, 200, 3}, ball, surfaces, {});
    CHECK(probe.luxels() == 216);
    const double unit = 1.0 / (mirtest::pi * 4 * 2.0 * 2.0);
    mir::Random random(1, mir::Stream::test, 0);
    for (int i = 0; i < 20; ++i) {
        // The half behind the camera: no luxel comes so close that rounding shows.
        Vpl vpl = ball.vpl(random.next_2d());
        if (vpl.position.z < 0.0f) continue;
        const Rgb r = probe.response(vpl);
        CHECK(r.r == Approx(0.6 * unit).epsilon(2e-5));
        CHECK(r.g == Approx(0.3 * unit).epsilon(2e-5));
        CHECK(r.b == 0.0f);
        CHECK(probe.flux(vpl, {2, 3, 4}) ==
              Approx((0.2126 * 0.6 * 2 + 0.7152 * 0.3 * 3) * unit).epsilon(2e-5));
    }
}

TEST_CASE("luxels that see nothing count as luxels") {
    const auto surfaces = one_material({0.6f, 0.6f, 0.6f});
    const Camera camera = Camera::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.2f);
    const Ball half{.right_half_only = true};
    const ProbeRays rays{camera, 1.0f, 256, 3};
    const ImageProbe<Lambert, mirtest::FreeSight> probe(rays, half, surfaces, {});
    const double whole = 0.6 / (mirtest::pi * 16);
    CHECK(probe.luxels() == 256);
    CHECK(probe.response(half.vpl({0.25f, 0.75f})).g == Approx(whole / 2).epsilon(2e-5));
}

// H0: over seeds, a probe's response to a place has the mean that an image of 9216 luxels has.
// Welch's t, 200 probes from seed 1001 and 10 images from seed 2001 on, level 1 % over 4 places.
// A probe that sees through walls, and one that averages over the luxels that see something, must
// be rejected at one place at least.
TEST_CASE("the response is that of the full image on average", "[statistical]") {
    const double level = mirtest::sidak(0.01, places.size());
    const Stage stage;
    const auto embree = [&](const Vpl& vpl, std::uint64_t seed) {
        return static_cast<double>(
            stage.probe(seed, stage.embree.visibility()).flux(vpl, {1, 1, 1}));
    };
    for (const double p : against_full_image(stage, embree)) CHECK(p > level);

    const auto blind = against_full_image(stage, [&](const Vpl& vpl, std::uint64_t seed) {
        return static_cast<double>(stage.probe(seed, mirtest::FreeSight{}).flux(vpl, {1, 1, 1}));
    });
    CHECK(*std::min_element(blind.begin(), blind.end()) < level);

    const auto over_seen = against_full_image(stage, [&](const Vpl& vpl, std::uint64_t seed) {
        const ProbeRays rays{stage.camera, 1.0f, 256, seed};
        double seen = 0.0;
        for (std::uint32_t i = 0; i < 256; ++i)
            seen += stage.embree.ray_caster().closest_hit(rays(i % 16, i / 16)) ? 1.0 : 0.0;
        return embree(vpl, seed) * 256.0 / seen;
    });
    CHECK(*std::min_element(over_seen.begin(), over_seen.end()) < level);
}

TEST_CASE("packets of rays and single rays give the same bits") {
    const Stage stage;
    const mirtest::BruteForceVisibility brute{mirtest::Referee(stage.geometry)};
    const auto packets = stage.probe(5, brute);
    const auto singles = stage.probe(5, SingleRays{brute});
    const auto repeated = stage.probe(5, brute);
    for (const Vpl& vpl : places) {
        const Rgb r = packets.response(vpl);
        CHECK(r.g > 0.0f);
        CHECK(singles.response(vpl) == r);
        CHECK(repeated.response(vpl) == r);
        CHECK(stage.probe(6, brute).response(vpl) != r);
    }
}

TEST_CASE("the bound of the shading holds in a probe") {
    const Ball ball;
    const auto surfaces = one_material({0.5f, 0.5f, 0.5f});
    const Camera camera = Camera::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.2f);
    const ImageProbe<Lambert, mirtest::FreeSight> probe({camera, 1.0f, 64, 1}, ball, surfaces, {},
                                                        {.bound = 0.01f});
    CHECK(probe.response(ball.vpl({0.25f, 0.75f})).r == Approx(0.5 / mirtest::pi * 0.01));
}

TEST_CASE("any Bsdf is probed") {
    const Stage stage;
    const mir::SurfaceTable<mir::CookTorrance> surfaces(stage.scene);
    const ImageProbe<mir::CookTorrance, mir::cpu::EmbreeVisibility> probe(
        {stage.camera, 1.0f, 256, 5}, stage.embree.ray_caster(), surfaces,
        stage.embree.visibility(), {.bound = 4.0f});
    const auto lambert = stage.probe(5, stage.embree.visibility());
    for (const Vpl& vpl : places)
        CHECK(probe.response(vpl).g == Approx(lambert.response(vpl).g).epsilon(1e-5));
}

TEST_CASE("probes of no luxel or of no aspect are refused") {
    const auto surfaces = one_material({0.5f, 0.5f, 0.5f});
    const auto make = [&](float aspect, std::uint32_t luxels) {
        return ImageProbe<Lambert, mirtest::FreeSight>({Camera{}, aspect, luxels, 0}, Ball{},
                                                       surfaces, {});
    };
    CHECK_THROWS_AS(make(1.0f, 0), mir::Error);
    CHECK_THROWS_AS(make(1.0f, 65537), mir::Error);
    CHECK_THROWS_AS(make(0.0f, 16), mir::Error);
    CHECK_THROWS_AS(make(std::nanf(""), 16), mir::Error);
    CHECK_NOTHROW(make(1.0f, 1));
}

TEST_CASE("a probe sees a wall whose shading normals turn away as luxels do") {
    mir::Scene scene;
    mir::Material gloss = mir::lambertian("gloss", {0.5f, 0.4f, 0.3f});
    gloss.specular = 1.0f;
    gloss.roughness = 0.3f;
    scene.add(gloss);
    const mir::SurfaceTable<mir::CookTorrance> surfaces(scene);
    const WallSeenFromBehindItsNormals wall;
    const Camera camera = Camera::look_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0}, 0.2f);
    const ImageProbe<mir::CookTorrance, mirtest::FreeSight> probe({camera, 1.0f, 64, 5}, wall,
                                                                  surfaces, {});
    const Vpl vpl{{1.5f, 0.0f, 1.0f}, glm::normalize(Vec3(-1.5f, 0, -1)), {1, 1, 1}};
    REQUIRE(probe.receivers() == 64);
    double sum = 0.0;
    for (std::uint32_t i = 0; i < 64; ++i) {
        const Vec3 wo = probe.surface(i).wo;
        const auto luxel = surfaces.luxel_surface(*wall.closest_hit({camera.position, -wo}), wo);
        CHECK(probe.surface(i).normal == luxel.normal);
        sum += static_cast<double>(
            luminance(mir::VplShading<mir::CookTorrance>{}(probe.hit(i), luxel, vpl)));
    }
    CHECK(sum > 0.0);
    CHECK(static_cast<double>(luminance(probe.response(vpl))) == Approx(sum / 64).epsilon(1e-5));
}
