// SPDX-License-Identifier: MIT
#include "micro/brute_force_cut.hpp"
#include "micro/shining_discs.hpp"
#include "mir/micro/buffer_gather.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::MicroBuffer;
using mir::SurfelHit;
using mir::SurfelTree;
using mir::Vec3;

TEST_CASE("A texel holds the nearest of all nodes that its direction meets, in every bit") {
    const World worlds[] = {sphere_in_box(), triangle_soup(60, 980)};
    const std::uint32_t side = GENERATE(1u, 8u, 24u);
    const float omega = GENERATE(0.0f, 0.01f, 0.2f);
    mir::Random random = test_random(981);
    std::uint32_t wrong = 0;
    std::uint32_t met = 0;
    for (const World& world : worlds) {
        const SurfelTree tree = tree_of(world, 5e-3f);
        for (int k = 0; k < 6; ++k) {
            const mir::SurfacePoint p = random_surface_point(world.geometry, random);
            const Vec3 n = p.geometric_normal;
            const Vec3 origin = mir::lift(p.position, n, world.geometry.ray_offset());
            // Shading normals need not be those of the surface.
            const Vec3 shading = glm::normalize(n + 0.3f * direction(random));
            MicroBuffer buffer(side, shading, random.next_2d());
            buffer.draw(tree.view(), origin, n, omega);
            for (std::uint32_t i = 0; i < buffer.size(); ++i) {
                const SurfelHit truth =
                    mirtest::brute_force_cut(tree, {origin, buffer.direction(i), n, omega});
                const SurfelHit& found = buffer.hit(i);
                wrong += found.t == truth.t && found.node == truth.node ? 0 : 1;
                met += found.node != SurfelHit::none ? 1 : 0;
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(met > 0);
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
        const mir::SurfelFace at = luxel(mir::lift(p.position, n, world.geometry.ray_offset()), n);
        const Gather gather{tree.view(), radiance.data(), options};
        CHECK(double(gather(at.hit, at.surface, test_random(i)).g) == Approx(1.0).epsilon(1e-5));
    }
    const World above = shining_ceiling();
    const SurfelTree square = tree_of(above, 1e-3f);
    const auto light = shining(square);
    const Gather gather{square.view(), light.data(), options};
    const mir::SurfelFace at = luxel({0, 0, 0});
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
    const mir::SurfelFace at = luxel({0, 0, 0});
    CHECK(mir::is_black(gather(at.hit, at.surface, test_random(983))));
    CHECK_THROWS_AS(mir::check(mir::BufferGatherOptions{.side = 0}), mir::Error);
    CHECK_THROWS_AS(mir::check(mir::BufferGatherOptions{.side = 25}), mir::Error);
    CHECK_THROWS_AS(mir::check(mir::BufferGatherOptions{.threshold = -1.0f}), mir::Error);
}
