// SPDX-License-Identifier: MIT
#include "conformance/masked_suite.hpp"
#include "conformance/see_through_suite.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "support/catch.hpp"

TEST_CASE("Embree knows masks") { mirtest::masked_suite<mir::cpu::EmbreeScene>(); }

TEST_CASE("Embree sees through") { mirtest::see_through_suite<mir::cpu::EmbreeScene>(); }

TEST_CASE("a masked Embree scene may be moved") {
    mir::Scene whole;
    whole.add(mirtest::masked(0.4f, 0.5f));
    mir::Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    whole.place(mesh);
    const mirtest::World world(std::move(whole));
    mir::cpu::EmbreeScene first(world.geometry);
    const mir::cpu::EmbreeScene second = std::move(first);
    CHECK(second.visibility().visible({0, 0, 1}, {0, 0, -1}));
    CHECK_FALSE(second.ray_caster().closest_hit({{0, 0, 1}, {0, 0, -1}}));
}
