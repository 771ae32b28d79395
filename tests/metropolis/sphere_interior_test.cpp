// SPDX-License-Identifier: MIT
//
// Whole paths, chains and normalisation inside a sphere with Lambertian walls and a bulb at its
// centre, where nothing has variance (docs/method.md, 9.3): every path of k edges has the same
// weight, every VPL lights every luxel alike.
#include "mir/data/gbuffer.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/place_vpls.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sampling/metropolis_sampler.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/analytic_sphere.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"
#include "support/path_lab.hpp"

#include <cmath>
#include <limits>

namespace {

using mir::Lambert;
using mir::Vec3;
using mirtest::AnalyticSphere;
using mirtest::Approx;
using mirtest::FreeSight;
using World = mir::PathWorld<Lambert, AnalyticSphere, FreeSight>;

constexpr float radius = 2.0f;
constexpr double intensity = 3.0;  // of the bulb, W sr^-1
constexpr double rho = 0.6;

/// A box around the sphere stands in for the mesh.
struct Sphere {
    mir::Scene scene = make();
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<Lambert> surfaces{scene};

    static mir::Scene make() {
        mir::Scene s;
        const std::uint32_t wall = s.add(mir::lambertian("wall", {0.6f, 0.6f, 0.6f}));
        s.place(mir::builtin::box("box", wall, Vec3(-radius), {2 * radius, 0, 0},
                                  {0, 2 * radius, 0}, {0, 0, 2 * radius}));
        s.point_lights.push_back({"bulb", {0, 0, 0}, {3, 3, 3}});
        return s;
    }
    mir::Camera camera = mir::Camera::look_at({0.3f, 0.2f, 0.1f}, {0, 0, -1}, {0, 1, 0}, 1.2f);

    [[nodiscard]] World world() const {
        return {geometry, lights, surfaces, {radius, 0, 0}, {}, camera};
    }
    /// P_c of paths of k edges: rho^(k - 1) I / (pi R^2), on the sphere of the lifted points.
    [[nodiscard]] double luminance_of(std::uint32_t k) const {
        const auto r = static_cast<double>(radius - geometry.ray_offset());
        return std::pow(rho, k - 1) * intensity / (mirtest::pi * r * r);
    }
};

using GBuffer = mir::BlockedGBuffer<Lambert::Params>;

GBuffer luxels_of(const Sphere& sphere) {
    GBuffer gbuffer({24, 20}, {16, 16});
    mir::InlineExecutor one;
    const mir::CameraRays rays{sphere.camera, {{24, 20}}};
    mir::fill_gbuffer<Lambert>(gbuffer, 0, rays, sphere.world().luxels.caster, sphere.surfaces,
                               one);
    return gbuffer;
}

/// Least distance between a luxel and a VPL, metres.
float nearest(const GBuffer& gbuffer, const mir::VplList& vpls) {
    float least = std::numeric_limits<float>::max();
    for (mir::TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
        const mir::Tile tile = gbuffer.tiles()[t];
        const auto layout = mir::BlockedLayout::of(tile);
        for (std::uint32_t y = 0; y < tile.height; ++y)
            for (std::uint32_t x = 0; x < tile.width; ++x)
                for (const mir::Vpl& vpl : vpls.vpls())
                    least = mir::smaller(
                        least,
                        glm::distance(gbuffer.view(t).hit(layout(x, y)).position, vpl.position));
    }
    return least;
}

/// Least and largest radiance of the light of VPLs that chains placed, after normalisation.
template <mir::Shading F>
std::pair<double, double> range_of_image(const Sphere& sphere, std::uint8_t max_bounce,
                                         const F& shading) {
    const GBuffer gbuffer = luxels_of(sphere);
    const World world = sphere.world();
    mir::MetropolisOptions options;
    options.states = 64;
    options.seed = 1;
    options.chains = 4;
    options.stride = 4;
    options.max_bounce = max_bounce;
    options.bootstrap = {1.0, 1024, 1024};
    // From both ends a try is lost now and then to directions that cannot meet the bulb.
    options.techniques = mir::PathTechniques::camera;
    mir::InlineExecutor one;
    const mir::PlacedVpls placed =
        place_vpls(mir::MetropolisSampler(world, options), gbuffer, world.visibility, shading, one);
    // Between points as close as 2 cm the rounding of positions shows at the tolerance of the
    // tests: the seed is one whose VPLs stay clear of the luxels.
    REQUIRE(nearest(gbuffer, placed.vpls) > 0.02f);
    const auto image =
        reconstruct(mir::sched::Cpu{one}, gbuffer, placed.vpls.span(), world.visibility, shading);
    const auto by_green = [](mir::Rgb a, mir::Rgb b) { return a.g < b.g; };
    const auto pixels = image.pixels();
    const auto [low, high] = std::minmax_element(pixels.begin(), pixels.end(), by_green);
    return {low->g, high->g};
}

/// A kernel with the luxel's cosine once too often.
struct SecondCosine : mir::VplShading<Lambert> {
    mir::Rgb operator()(const mir::Hit& hit, const Surface& s, const mir::Vpl& vpl) const {
        const Vec3 wi = glm::normalize(vpl.position - hit.position);
        return mir::VplShading<Lambert>::operator()(hit, s, vpl) *
               mir::larger(glm::dot(wi, s.normal), 0.0f);
    }
};

}  // namespace

TEST_CASE("inside a sphere every path of k edges has the weight P_c, however it was built") {
    const Sphere sphere;
    const World world = sphere.world();
    const auto check = [&](std::uint32_t k, const mirtest::Moments& weights) {
        CAPTURE(k, weights.mean());
        CHECK(weights.mean() == Approx(sphere.luminance_of(k)).epsilon(1e-5));
        CHECK(std::sqrt(weights.variance()) < 1e-5 * weights.mean());
    };
    for (std::uint32_t k = 3; k <= 8; ++k) {
        const mir::TechniqueTable table(k, k, mir::PathTechniques::camera);
        check(k, mirtest::generator_weights(world, table, 7, 300));
        for (std::uint32_t s = 1; s < k; ++s)
            check(k, mirtest::technique_weights(world, {k, s}, 9, 300,
                                                [&](const mir::Path&, const mir::PathMeasure& m) {
                                                    return technique_density(m, k, s);
                                                }));
    }
}

TEST_CASE("inside a sphere the density of light that forgets a cosine is noticed") {
    const Sphere sphere;
    const World world = sphere.world();
    const auto deviation = [&](const auto& factor) {
        const mirtest::Moments weights = mirtest::technique_weights(
            world, {4, 1}, 8, 300, [&](const mir::Path& path, const mir::PathMeasure& m) {
                return technique_density(m, 4, 1) * factor(path);
            });
        return std::sqrt(weights.variance()) / weights.mean();
    };
    CHECK(deviation([](const mir::Path&) { return 1.0; }) < 1e-5);
    CHECK(deviation([](const mir::Path& path) {
              const Vec3 w = glm::normalize(path.x(2).position - path.x(3).position);
              return 1.0 / static_cast<double>(glm::dot(w, path.x(3).normal));
          }) > 0.1);
}

TEST_CASE("inside a sphere chains and normalisation give D_2 to every luxel, to rounding") {
    const Sphere sphere;
    const auto [low, high] = range_of_image(sphere, 2, mir::VplShading<Lambert>{});
    CHECK(low == Approx(sphere.luminance_of(3)).epsilon(1e-5));
    CHECK(high == Approx(sphere.luminance_of(3)).epsilon(1e-5));
}

TEST_CASE("inside a sphere all luxels get the same light of any bounces, but for a wrong kernel") {
    const Sphere sphere;
    const auto right = range_of_image(sphere, 6, mir::VplShading<Lambert>{});
    CHECK(right.second == Approx(right.first).epsilon(1e-5));
    const auto wrong = range_of_image(sphere, 6, SecondCosine{});
    CHECK(wrong.second > 1.05 * wrong.first);
}
