// SPDX-License-Identifier: MIT
#include "micro/surfel_worlds.hpp"
#include "mir/micro/surfel_traverse.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::SurfelTree;
using mir::Vec3;

namespace {

bool is_below(const SurfelTree& tree, std::uint32_t node, Vec3 origin, Vec3 normal) {
    const Vec3 to_centre = tree.nodes()[node].centre - origin;
    return mir::detail::lies_below(tree.nodes()[node], normal, to_centre,
                                   mir::detail::padded_radius(tree.nodes()[node], to_centre));
}

/// Height above a plane of the highest point of the discs below a node, metres.
double highest(const SurfelTree& tree, const mir::SurfelNode& node, Vec3 origin, Vec3 normal) {
    using mir::detail::Double3;
    const Double3 n = glm::normalize(Double3(normal));
    double most = -1e30;
    for (const mir::Surfel& s : tree.surfels().subspan(node.first, node.count)) {
        const double tilt = glm::length(glm::cross(n, glm::normalize(Double3(s.normal))));
        most = std::max(
            most, glm::dot(n, Double3(s.position) - Double3(origin)) + tilt * double(s.radius));
    }
    return most;
}

}  // namespace

TEST_CASE("A wall lies below all points that are lifted from it, as a whole and in parts") {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(mir::builtin::quad("wall", grey, {-1, -1, 1}, {2, 0.1f, 0}, {0, 2, 0.3f}));
    const World world(std::move(scene));
    const SurfelTree tree = tree_of(world, 1e-3f);
    mir::Random random = test_random(984);
    std::uint32_t missed = 0;
    for (int k = 0; k < 200; ++k) {
        const mir::SurfacePoint p = random_surface_point(world.geometry, random);
        const Vec3 n = p.geometric_normal;
        const Vec3 origin = mir::lift(p);
        for (std::uint32_t i = 0; i < tree.nodes().size(); ++i)
            missed += is_below(tree, i, origin, n) ? 0 : 1;
    }
    CHECK(missed == 0);
}

TEST_CASE("Nothing that reaches above a plane lies below it") {
    const World worlds[] = {sphere_in_box(), thin_wall()};
    mir::Random random = test_random(985);
    std::uint32_t wrong = 0;
    std::uint32_t below = 0;
    for (const World& world : worlds) {
        const SurfelTree tree = tree_of(world, 2e-2f);
        for (int k = 0; k < 50; ++k) {
            const mir::SurfacePoint p = random_surface_point(world.geometry, random);
            const Vec3 n = k % 2 == 0 ? p.geometric_normal : direction(random);
            const Vec3 origin = mir::lift(p.position, n, p.offset);
            for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
                if (!is_below(tree, i, origin, n)) continue;
                ++below;
                wrong += highest(tree, tree.nodes()[i], origin, n) < 0.0 ? 0 : 1;
            }
        }
    }
    CHECK(below > 0);
    CHECK(wrong == 0);
}
