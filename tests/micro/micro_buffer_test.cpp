// SPDX-License-Identifier: MIT
#include "micro/brute_force_cut.hpp"
#include "micro/shining_discs.hpp"
#include "mir/micro/buffer_gather.hpp"
#include "mir/micro/check_gather.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "support/catch.hpp"

#include <memory>

using namespace mirtest;
using mir::SurfelHit;
using mir::SurfelTree;
using mir::Vec3;

namespace {

/// Texels of buffer k that do not hold the nearest of all nodes at which the walk for it ends and
/// which their direction meets.
template <class Buffers>
std::uint32_t wrong_texels(const Buffers& buffers, std::uint32_t k, const SurfelTree& tree,
                           mir::SurfelRay point, float threshold, std::uint32_t& met) {
    std::uint32_t wrong = 0;
    const float share = threshold / static_cast<float>(buffers.size());
    for (std::uint32_t i = 0; i < buffers.size(); ++i) {
        point.direction = buffers.direction(k, i);
        const SurfelHit truth = mirtest::brute_force_cut(tree, point, [&](std::uint32_t node) {
            return buffers.ends_at(tree.view(), node, k, share);
        });
        wrong += buffers.distance(k, i) == truth.t && buffers.node(k, i) == truth.node ? 0 : 1;
        met += truth.node != SurfelHit::none ? 1 : 0;
    }
    return wrong;
}

struct Lookout {
    Vec3 origin;
    Vec3 normal;
};

/// A point of a surface, others next to it as luxels are, whose normals may differ, and one
/// anywhere.
std::vector<Lookout> lookouts(const World& world, std::uint32_t count, mir::Random& random) {
    const auto lifted = [&](const mir::SurfacePoint& p) { return mir::lift(p); };
    const mir::SurfacePoint first = random_surface_point(world.geometry, random);
    const mir::SurfacePoint other = random_surface_point(world.geometry, random);
    std::vector<Lookout> points{{lifted(first), first.geometric_normal}};
    while (points.size() < count) {
        const Vec3 n = glm::normalize(first.geometric_normal + 0.1f * direction(random));
        points.push_back({points[0].origin + 0.01f * random.next() * direction(random), n});
    }
    if (count > 2) points[2] = {lifted(other), other.geometric_normal};
    return points;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "A texel holds the nearest of all nodes that its direction meets, in every bit", "[slow]",
    ((std::uint32_t Side, std::uint32_t Waiting), Side, Waiting), (8, 320), (8, 113), (24, 320)) {
    const World worlds[] = {sphere_in_box(), triangle_soup(60, 980)};
    const std::uint32_t side = GENERATE(1u, Side);
    const float threshold = GENERATE(0.0f, 0.2f, 4.0f);
    // From all around to so sharp that the rounding of directions spans texels.
    const float sharpness = GENERATE(0.7f, 30.0f, 16384.0f);
    mir::Random random = test_random(981);
    const mir::LaneGroup group;
    const auto space = std::make_unique<mir::MicroBufferSpace<Side, true, Waiting>>();
    std::uint32_t wrong = 0;
    std::uint32_t met = 0;
    for (const World& world : worlds) {
        const SurfelTree tree = tree_of(world, 5e-3f);
        const auto check = [&]<class Texels>(mir::MicroPoint<Texels>* memory, auto make_texels) {
            mir::MicroBuffers buffers(group, *space, memory, side);
            std::vector<mir::SurfelRay> points;
            for (const Lookout& at : lookouts(world, space->pictures, random)) {
                const auto k = static_cast<std::uint32_t>(points.size());
                buffers.place(k, {at.origin, at.normal, make_texels(at.normal), random.next_2d()});
                points.push_back({at.origin, {0, 0, 1}, at.normal});
            }
            buffers.draw(tree.view(), threshold);
            for (std::uint32_t k = 0; k < points.size(); ++k)
                wrong += wrong_texels(buffers, k, tree, points[k], threshold, met);
        };
        // Shading normals need not be those of the surface.
        check(space->even, [&](Vec3 n) {
            return mir::CosineTexels(glm::normalize(n + 0.3f * direction(random)));
        });
        for (const float tilt : {0.0f, 1.0f})
            check(space->sharp, [&](Vec3 n) {
                const Vec3 axis = glm::normalize(n + tilt * direction(random));
                return mir::LobeTexels({axis, sharpness});
            });
    }
    CHECK(wrong == 0);
    CHECK(met > 0);
}

TEST_CASE("Directions that meet a sphere lie in the texels that it may cover") {
    mir::Random random = test_random(988);
    std::uint32_t outside = 0;
    double texels = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const mir::CosineTexels map(direction(random));
        const Vec3 to_centre = (0.1f + random.next()) * direction(random);
        // From far smaller than a texel to all around.
        const float radius = glm::length(to_centre) * std::exp(-9.0f * random.next()) * 1.05f;
        const mir::TexelReach reach = map.reach(to_centre, radius);
        texels += double(std::max(0.0f, reach.high.x - reach.low.x));
        for (int j = 0; j < 8; ++j) {
            const mir::Vec2 u =
                j < 2 ? random.next_2d()
                      : glm::clamp(0.5f * (reach.low + reach.high) +
                                       (random.next_2d() - 0.5f) * (reach.high - reach.low + 0.02f),
                                   0.0f, 1.0f);
            const Vec3 wi = map.direction(u);
            const float along = glm::dot(wi, to_centre);
            const bool is_met = along > 0.0f && glm::length(along * wi - to_centre) < radius;
            const bool is_inside = glm::all(glm::greaterThanEqual(u, reach.low)) &&
                                   glm::all(glm::lessThanEqual(u, reach.high));
            outside += is_met && !is_inside ? 1 : 0;
        }
    }
    CHECK(outside == 0);
    // A rectangle of 0.81 of the sphere's angle to either side, which holds it anywhere, has 0.38.
    CHECK(texels / 20000 < 0.3);
}

TEST_CASE("Texels of a lobe share the sphere by their density") {
    const float k = GENERATE(0.5f, 3.0f, 12.0f);
    const Vec3 axis = glm::normalize(Vec3(0.3f, -0.5f, 0.2f));
    const mir::LobeTexels texels({axis, k});
    constexpr int side = 512;
    double area = 0.0;
    double along = 0.0;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const Vec3 w = texels.direction((mir::Vec2(i, j) + 0.5f) / float(side));
            const double share = 1.0 / (double(texels.density(w)) * side * side);
            area += share;
            along += share * double(glm::dot(w, axis));
        }
    // The midpoint rule over a density that varies by (1 + 2 k)^2.
    CHECK(area / (4.0 * 3.14159265358979) == Approx(1.0).epsilon(1e-3));
    CHECK(along == Approx(0.0).margin(1e-2));
}

TEST_CASE("Buffers with a lobe of their own gather the same light as others, with less noise") {
    const World world = shining_room();
    const SurfelTree tree = tree_of(world, 0.01f);
    auto radiance = shining(tree);
    // Light that varies over the room, so that noise is seen.
    for (std::uint32_t i = 0; i < radiance.size(); ++i) {
        const Vec3 c = tree.nodes()[i].centre;
        radiance[i].front = radiance[i].front * (1.0f + sinf(40.0f * c.x) * sinf(40.0f * c.z));
    }
    using B = mir::CookTorrance;
    const mir::SurfacePoint p = [&] {
        mir::Random random = test_random(986);
        return random_surface_point(world.geometry, random);
    }();
    const Vec3 n = world.geometry.front_normal(p.triangle);
    const Vec3 wo = glm::normalize(n + 0.7f * mir::Frame::around(n).tangent);
    mir::Surface<B::Params> surface;
    surface.normal = n;
    surface.wo = wo;
    surface.bsdf = {{0.2f, 0.2f, 0.2f}, {0.6f, 0.6f, 0.6f}, 1.0f, 0.1f};
    const mir::Hit hit{mir::lift(p.position, n, p.offset), n};
    struct Spread {
        double mean = 0.0;
        double square = 0.0;
    };
    constexpr int draws = 400;
    const auto spread = [&](mir::BufferWarp warp) {
        const mir::BufferGather<mir::Space::host, B> gather{
            tree.view(), radiance.data(), {.side = 8, .threshold = 0.0f, .warp = warp}};
        Spread s;
        for (std::uint64_t i = 0; i < draws; ++i) {
            const double light = double(gather(hit, surface, test_random(1000 + i)).g) / draws;
            s.mean += light;
            s.square += light * light * draws;
        }
        return s;
    };
    const Spread even = spread(mir::BufferWarp::hemisphere);
    const Spread sharp = spread(mir::BufferWarp::importance);
    const double even_variance = even.square - even.mean * even.mean;
    const double sharp_variance = sharp.square - sharp.mean * sharp.mean;
    // H0: both means are of the same light; |z| > 3.29 has a probability of 0.001.
    const double z = (even.mean - sharp.mean) / std::sqrt((even_variance + sharp_variance) / draws);
    CHECK(std::fabs(z) < 3.29);
    CHECK(sharp_variance < 0.25 * even_variance);
}

TEST_CASE(
    "Micro-buffers gather the light of a room that shines alike, and that of a square above") {
    const World world = shining_room();
    const SurfelTree tree = tree_of(world, 0.01f);
    const auto radiance = shining(tree);
    using Gather = mir::BufferGather<mir::Space::host, mir::Lambert>;
    mir::BufferGatherOptions options;
    options.side = GENERATE(8u, 24u);
    options.threshold = GENERATE(0.0f, 1.0f, 4.0f);
    mir::Random random = test_random(982);
    for (std::uint64_t i = 0; i < 20; ++i) {
        const mir::SurfacePoint p = random_surface_point(world.geometry, random);
        const Vec3 n = world.geometry.front_normal(p.triangle);
        const TestLuxel at = luxel(mir::lift(p.position, n, p.offset), n);
        const Gather gather{tree.view(), radiance.data(), options};
        CHECK(double(gather(at.hit, at.surface, test_random(i)).g) == Approx(1.0).epsilon(1e-5));
    }
    const World above = shining_ceiling();
    const SurfelTree square = tree_of(above, 1e-3f);
    const auto light = shining(square);
    const Gather gather{square.view(), light.data(), options};
    const TestLuxel at = luxel({0, 0, 0});
    double sum = 0.0;
    for (std::uint64_t i = 0; i < 64; ++i)
        sum += double(gather(at.hit, at.surface, test_random(i)).g) / 64;
    // The closed form, and what rims of discs add: much where nodes are large.
    const double truth = 1.7408395030 / 3.14159265358979;
    CHECK((sum > 0.98 * truth && sum < 1.15 * truth));
    if (options.side == 24 || options.threshold == 0.0f) CHECK(sum < 1.05 * truth);
}

TEST_CASE("Micro-buffers of an empty scene are dark, sides out of range are refused") {
    const SurfelTree none = tree_of(World{mir::Scene{}}, 1.0f);
    const mir::BufferGather<mir::Space::host, mir::Lambert> gather{none.view(), nullptr, {}};
    const TestLuxel at = luxel({0, 0, 0});
    CHECK(mir::is_black(gather(at.hit, at.surface, test_random(983))));
    CHECK_THROWS_AS(mir::check(mir::BufferGatherOptions{.side = 0}), mir::Error);
    CHECK_THROWS_AS(mir::check(mir::BufferGatherOptions{.side = 25}), mir::Error);
    CHECK_THROWS_AS(mir::check(mir::BufferGatherOptions{.threshold = -1.0f}), mir::Error);
}
