// SPDX-License-Identifier: MIT
#include "micro/shining_discs.hpp"
#include "mir/micro/buffer_gather.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::SurfelNode;
using mir::SurfelTree;
using mir::Vec3;
using mir::detail::Fate;

namespace {

using Point = mir::MicroPoint<mir::CosineTexels>;

/// What becomes of a node for one point, by the functions that a walk for it alone would ask.
Fate fate_of(const SurfelNode& node, const Point& p, float share) {
    const Vec3 to_centre = node.centre - p.origin;
    const float padded = mir::detail::padded_radius(node, to_centre);
    if (mir::detail::lies_below(node, p.normal, to_centre, padded)) return Fate::passed_by;
    if (node.is_leaf()) return Fate::ended;
    const float sine2 = mir::cap_sine_squared(share / mir::inv_pi);
    if (!mir::detail::stops_at(node, p.normal, to_centre, sine2)) return Fate::opened;
    return glm::dot(p.normal, to_centre) >= 0.0f ? Fate::ended : Fate::passed_by;
}

/// Four points within `spread` of a point of the surface, whose normals are tilted by up to
/// `tilt`.
std::vector<Point> some_points(const World& world, float spread, float tilt, mir::Random& random) {
    const mir::SurfacePoint p = random_surface_point(world.geometry, random);
    const Vec3 origin = mir::lift(p);
    std::vector<Point> points;
    for (int k = 0; k < 4; ++k) {
        const Vec3 n =
            glm::normalize(p.geometric_normal + tilt * random.next() * direction(random));
        points.push_back({origin + spread * random.next() * direction(random), n,
                          mir::CosineTexels(n), random.next_2d()});
    }
    return points;
}

}  // namespace

TEST_CASE("What is sure of a node for some points is what becomes of it for each of them") {
    const World worlds[] = {sphere_in_box(), triangle_soup(60, 990)};
    const float spread = GENERATE(0.0f, 1e-3f, 0.1f);
    const float tilt = GENERATE(0.0f, 0.2f, 3.0f);
    const float threshold = GENERATE(0.25f, 1.0f, 16.0f);
    mir::Random random = test_random(991);
    std::uint32_t wrong = 0;
    double sure = 0.0;
    double all = 0.0;
    for (const World& world : worlds) {
        const SurfelTree tree = tree_of(world, 1e-2f);
        for (int draw = 0; draw < 12; ++draw) {
            const auto points = some_points(world, spread, tilt, random);
            const float share = threshold / 64.0f;
            const mir::detail::PointGroup group(points.data(), 0b1111u, share);
            for (const SurfelNode& node : tree.nodes()) {
                const Fate fate = group.fate(node);
                all += 1.0;
                if (fate == Fate::unsure) continue;
                sure += 1.0;
                for (const Point& p : points) wrong += fate_of(node, p, share) == fate ? 0 : 1;
            }
        }
    }
    CHECK(wrong == 0);
    // Half of the nodes lie below a tangent plane, of which nothing is sure.
    if (spread < 0.01f && tilt == 0.0f) CHECK(sure > 0.25 * all);
}

TEST_CASE("Walls that meet are not opened for points of both when those of one pass them by") {
    constexpr float lift = 1e-4f;
    std::vector<Point> points;
    for (const float aside : {-1e-3f, 1e-3f}) {
        points.push_back({{2e-3f, aside, lift}, {0, 0, 1}, {}, {}});
        points.push_back({{lift, aside, 2e-3f}, {1, 0, 0}, {}, {}});
    }
    const float share = 1.0f / 64.0f;
    const mir::detail::PointGroup group(points.data(), 0b1111u, share);
    for (const float size : {1.0f, 0.5f, 0.25f}) {
        SurfelNode floor;
        floor.centre = {size, 0, 0};
        floor.radius = 1.42f * size;
        floor.axis = {0, 0, 1};
        floor.right = 2;
        CHECK(fate_of(floor, points[0], share) == Fate::passed_by);
        CHECK(fate_of(floor, points[1], share) == Fate::opened);
        CHECK(group.fate(floor) == Fate::unsure);
    }
}

TEST_CASE("What a point sees of a node lies in the texels that its group gives the node") {
    const World world = sphere_in_box();
    const SurfelTree tree = tree_of(world, 1e-2f);
    const float spread = GENERATE(0.0f, 1e-3f, 0.05f);
    mir::Random random = test_random(993);
    std::uint32_t outside = 0;
    std::uint32_t met = 0;
    for (int draw = 0; draw < 12; ++draw) {
        const auto points = some_points(world, spread, 0.0f, random);
        const mir::detail::PointGroup group(points.data(), 0b1111u, 1.0f / 64.0f);
        const Point& p = points[static_cast<std::size_t>(draw) % 4];
        for (const SurfelNode& node : tree.nodes()) {
            if (!group.is_far(node, 8)) continue;
            const mir::TexelReach reach = group.reach(points[0].texels, node);
            const Vec3 to_centre = node.centre - p.origin;
            for (int i = 0; i < 64; ++i) {
                const mir::Vec2 u = 0.125f * (mir::Vec2(i % 8, i / 8) + p.jitter);
                const Vec3 wi = p.texels.direction(u);
                const float along = glm::dot(wi, to_centre);
                if (along < 0.0f || glm::length(along * wi - to_centre) > node.radius) continue;
                ++met;
                outside += glm::all(glm::greaterThanEqual(u, reach.low)) &&
                                   glm::all(glm::lessThanEqual(u, reach.high))
                               ? 0
                               : 1;
            }
        }
    }
    CHECK(outside == 0);
    CHECK(met > 1000);
}
