// SPDX-License-Identifier: MIT
#include "mir/cpu/embree_scene.hpp"

#include "conformance/packet_suite.hpp"
#include "conformance/ray_caster_suite.hpp"
#include "conformance/visibility_suite.hpp"
#include "support/catch.hpp"

TEST_CASE("Embree's visibility keeps the axioms") {
    mirtest::visibility_suite<mir::cpu::EmbreeScene>();
}

TEST_CASE("Embree's packets keep the axiom") { mirtest::packet_suite<mir::cpu::EmbreeScene>(); }

TEST_CASE("Embree's ray caster keeps the axioms") {
    mirtest::ray_caster_suite<mir::cpu::EmbreeScene>();
}

TEST_CASE("An Embree scene without triangles hides nothing and is never hit") {
    const mirtest::World world{mir::Scene{}};
    const mir::cpu::EmbreeScene scene(world.geometry);
    CHECK(scene.visibility().visible({0, 0, 0}, {1, 2, 3}));
    CHECK_FALSE(scene.ray_caster().closest_hit({{0, 0, 0}, {0, 0, 1}}));
    mir::PointPacket points{};
    CHECK(scene.visibility().visible_packet({1, 1, 1}, points, 0x8001) == 0x8001);
}

TEST_CASE("A scene beyond the numbers that Embree takes is refused") {
    for (const float scale : {1e17f, 2e18f, 1e30f}) {
        mir::Scene scene = mirtest::sphere_in_box().scene;
        for (mir::Mesh& mesh : scene.meshes)
            for (mir::Vec3& p : mesh.positions) p *= scale;
        const mir::WorldGeometry geometry(scene);
        if (scale < 1e18f)
            CHECK_NOTHROW(mir::cpu::EmbreeScene(geometry));
        else
            CHECK_THROWS_AS(mir::cpu::EmbreeScene(geometry), mir::Error);
    }
}

TEST_CASE("An Embree scene may be moved while its handles stay valid") {
    const mirtest::World world = mirtest::sphere_in_box();
    mir::cpu::EmbreeScene first(world.geometry);
    const auto visibility = first.visibility();
    const mir::cpu::EmbreeScene second = std::move(first);
    CHECK_FALSE(visibility.visible({0, 0, 0.9f}, {0, 0, -0.9f}));
    CHECK(visibility.visible({0, 0.8f, 0.9f}, {0, 0.8f, -0.9f}));
}
