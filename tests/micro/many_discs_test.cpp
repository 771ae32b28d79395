// SPDX-License-Identifier: MIT
#include "micro/nearest_triangle.hpp"
#include "micro/surfel_worlds.hpp"
#include "mir/micro/surfel_traverse.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::SurfelHit;
using mir::SurfelRay;
using mir::SurfelTree;
using mir::Vec3;

TEST_CASE("A million discs take the memory that is said, and exact rays meet the triangles") {
    const World world(mir::builtin::cornell_box(mir::builtin::Lamp::down));
    // Halves around means are grown fastest; what exact rays meet does not depend on them.
    mir::SurfelTreeOptions options;
    options.sphere = mir::SphereFit::mean;
    options.split = mir::SurfelSplit::median;
    const SurfelTree tree = tree_of(world, 3.1e-5f, options);
    const std::size_t n = tree.surfels().size();
    REQUIRE(n > 1'000'000);
    CHECK(tree.nodes().size() == 2 * n - 1);
    CHECK(tree.bytes() ==
          (2 * n - 1) * (sizeof(mir::SurfelNode) + sizeof(mir::Rgb) + sizeof(float)) +
              n * sizeof(mir::Surfel));
    CHECK(tree.bytes() < 200 * n);
    mir::Random random = test_random(990);
    std::uint32_t met = 0;
    std::uint32_t wrong = 0;
    for (int i = 0; i < 2000; ++i) {
        const SurfelRay ray{Vec3(0, 1, 0) + 0.9f * point_in_cube(random), direction(random)};
        const double exact = nearest_triangle(world.geometry, ray);
        const double t = double(mir::closest_surfel(tree.view(), ray).t);
        met += std::isfinite(exact) ? 1 : 0;
        wrong += t == exact || std::fabs(t - exact) < 1e-4 ? 0 : 1;
    }
    CHECK(met > 1000);
    CHECK(wrong <= 2);  // edges in profile, where rounding decides
}

TEST_CASE("A single triangle is a tree of one disc that ends at its edges") {
    mir::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    const World world = world_of(std::move(mesh));
    const SurfelTree tree = tree_of(world, 10.0f);
    REQUIRE(tree.nodes().size() == 1);
    const float omega = GENERATE(0.0f, 6.0f);
    const auto met = [&](float x, float y) {
        const SurfelRay ray{{x, y, 3}, {0, 0, -1}, {0, 0, 0}, omega};
        return mir::closest_surfel(tree.view(), ray);
    };
    CHECK(double(met(0.5f, 0.25f).t) == Approx(3.0));
    CHECK(met(0.5f, 0.25f).front);
    CHECK(met(1.99f, 0.001f).node == 0);
    CHECK(met(0.001f, 0.99f).node == 0);
    // Inside of the covering disc, outside of the triangle.
    CHECK(met(1.1f, 0.5f).node == SurfelHit::none);
    CHECK(met(0.5f, -0.01f).node == SurfelHit::none);
    CHECK(met(-0.01f, 0.3f).node == SurfelHit::none);
}
