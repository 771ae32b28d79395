// SPDX-License-Identifier: MIT
#include "micro/surfel_worlds.hpp"
#include "mir/micro/surfel_traverse.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::SurfelNode;
using mir::SurfelTree;
using mir::Vec3;

namespace {

/// How far a point would have to move, in units of a node's radius, for all discs below it to show
/// the point the side that most of them show; 0 where they do.
double doubt_about(const SurfelTree& tree, const SurfelNode& node, Vec3 origin) {
    double above = 0.0;
    double below = 0.0;
    for (const mir::Surfel& s : tree.surfels().subspan(node.first, node.count)) {
        const double height = glm::dot(glm::normalize(glm::dvec3(s.normal)),
                                       glm::dvec3(s.position) - glm::dvec3(origin));
        above = std::max(above, height);
        below = std::max(below, -height);
    }
    return std::min(above, below) / double(node.radius);
}

/// A point somewhere around a node, or in the plane of one of its discs.
Vec3 point_near(const SurfelTree& tree, const SurfelNode& node, mir::Random& random,
                bool in_plane) {
    const float distance = node.radius * std::exp2(6.0f * random.next());
    const Vec3 away = direction(random);
    if (!in_plane) return node.centre + distance * away;
    const mir::Surfel& s = tree.surfels()[node.first];
    return s.position + distance * glm::normalize(glm::cross(s.normal, away));
}

}  // namespace

TEST_CASE("Nodes that show one side do so with all their discs, or nearly") {
    const World worlds[] = {sphere_in_box(), thin_wall(), triangle_soup(60, 992)};
    mir::Random random = test_random(993);
    std::uint32_t one_side = 0;
    std::uint32_t exactly = 0;
    double worst = 0.0;
    for (const World& world : worlds) {
        const SurfelTree tree = tree_of(world, 5e-3f);
        for (const SurfelNode& node : tree.nodes()) {
            if (node.is_leaf()) continue;
            for (int k = 0; k < 6; ++k) {
                const Vec3 origin = point_near(tree, node, random, k % 2 == 0);
                if (!mir::detail::shows_one_side(node, node.centre - origin)) continue;
                const double doubt = doubt_about(tree, node, origin);
                ++one_side;
                exactly += doubt == 0.0 ? 1 : 0;
                worst = std::max(worst, doubt);
            }
        }
    }
    CHECK(one_side > 1000);
    CHECK(exactly > one_side / 2);
    CHECK(worst < 1.0 / 1024.0);
}
