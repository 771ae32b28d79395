// SPDX-License-Identifier: MIT
#include "mir/cpu/embree_scene.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"

TEST_CASE("a failure inside Embree becomes an error in words") {
    const mir::Scene scene = mir::builtin::sphere_room(mir::builtin::Lamp::down);
    const mir::WorldGeometry geometry(scene);
    try {
        const mir::cpu::EmbreeScene engine(geometry, 10'000);
        FAIL("Embree built a scene of 1 888 triangles in 10 000 bytes");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::device);
        CHECK(std::string(e.what()).find("Embree reported") != std::string::npos);
    }
    // The failure belongs to that scene alone: the next one builds.
    const mir::cpu::EmbreeScene engine(geometry);
    CHECK(engine.visibility().visible({0, 3, 3}, {1, 3, 3}));
}
