// SPDX-License-Identifier: MIT
#include "mir/micro/triangle_gather.hpp"

#include "conformance/brute_force.hpp"
#include "micro/surfel_worlds.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::SurfelHit;
using mir::Vec2;
using mir::Vec3;

TEST_CASE("a point of a triangle belongs to the piece that it lies in") {
    mir::Random random = test_random(1321);
    for (std::uint32_t level = 0; level < 6; ++level)
        for (std::uint64_t piece = 0; piece < std::uint64_t{1} << 2 * level; ++piece) {
            const mir::detail::PiecePlace p = mir::detail::piece_place(piece, level);
            const auto sign = static_cast<float>(p.sign);
            const auto scale = static_cast<float>(1u << level);
            Vec2 in = 0.98f * random.next_2d() + Vec2(0.005f);
            if (in.x + in.y > 0.99f) in = Vec2(0.99f) - in;
            in = glm::max(in, Vec2(0.001f));
            const Vec2 at = (Vec2(static_cast<float>(p.i), static_cast<float>(p.j)) + sign * in);
            CHECK(mir::detail::piece_at(at / scale, level) == piece);
        }
}

TEST_CASE("rays to the triangles see the disc that exact rays to the discs see") {
    for (const float area : {10.0f, 0.02f, 1e-3f}) {
        const World world = triangle_soup(60, 1322);
        const mir::SurfelTree tree = tree_of(world, area);
        const mir::SurfelPlaces places(tree, world.geometry);
        const BruteForceScene traced(world.geometry);
        const mir::TriangleRays<decltype(traced.ray_caster())> rays{traced.ray_caster(), &places};
        const mir::TreeRays<mir::Space::host> walk{tree.view()};
        mir::Random random = test_random(1323);
        int met = 0;
        int different = 0;
        for (int i = 0; i < 2000; ++i) {
            const auto aim = static_cast<std::uint32_t>(random.next() * 60.0f);
            const Vec3 to = world.geometry.corner(aim, 0);
            const Vec3 from = to + 2.0f * mir::square_to_sphere(random.next_2d());
            const Vec3 near = to + 0.2f * mir::square_to_sphere(random.next_2d());
            const mir::SurfelRay ray{from, glm::normalize(near - from), Vec3(0.0f)};
            const SurfelHit a = rays(ray);
            const SurfelHit b = walk(ray);
            met += a.node != SurfelHit::none ? 1 : 0;
            // Rays through an edge of pieces, which overlap by rounding.
            different += a.node != b.node || (a.node != SurfelHit::none && a.front != b.front);
        }
        CHECK(met > 100);
        CHECK(different <= 4);
    }
}

TEST_CASE("every disc of a triangle is found at its centre, however small") {
    for (const float size : {1.0f, 1e-4f, 1e4f}) {
        mir::Scene scene;
        const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
        scene.place(mir::builtin::quad("needle", grey, {size, size, -3 * size}, {size, 0, 0},
                                       {0.5f * size, 1e-3f * size, 0}));
        scene.place(mir::builtin::quad("square", grey, {0, 0, 0}, {size, 0, 0}, {0, size, 0}));
        const World world(std::move(scene));
        const mir::SurfelTree tree = tree_of(world, 1e-4f * size * size);
        const mir::SurfelPlaces places(tree, world.geometry);
        for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
            if (!tree.nodes()[i].is_leaf()) continue;
            const mir::Surfel& s = tree.surfels()[tree.nodes()[i].first];
            CHECK(places.leaf(s.triangle,
                              mir::detail::barycentrics_at(world.geometry, s.triangle,
                                                           mir::detail::Double3(s.position))) == i);
        }
    }
}

TEST_CASE("discs of another scene have no place") {
    const World world = triangle_soup(8, 1324);
    const World other = triangle_soup(4, 1324);
    CHECK_THROWS_AS(mir::SurfelPlaces(tree_of(world, 1.0f), other.geometry), mir::Error);
}
