// SPDX-License-Identifier: MIT
#include "conformance/worlds.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"

namespace {

using mir::Vec3;

const std::array<const char*, 3> paper_scenes{"car", "car-grille", "garage"};

/// A built-in scene with its ray engine.
struct Room {
    mirtest::World world;
    mir::cpu::EmbreeScene engine{world.geometry};

    explicit Room(const std::string& name) : world(mir::builtin::make(name)) {}

    [[nodiscard]] const mir::Material& material(const mir::SurfacePoint& p) const {
        return world.scene.materials[p.material];
    }
};

/// What the camera sees in a grid of pixels.
struct View {
    double car = 0.0;    ///< share of pixels with paint, tyres, fabric, ...
    double lamp = 0.0;   ///< share of pixels with a lamp
    float nearest = 99;  ///< distance of the nearest surface, metres
    int lost = 0;        ///< rays that hit nothing
    int backs = 0;       ///< rays that see a surface from behind
};

View view_of(const Room& room) {
    const mir::Camera& camera = room.world.scene.cameras[0];
    View v;
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 120; ++x) {
            const mir::Vec2 film((static_cast<float>(x) + 0.5f) / 120,
                                 (static_cast<float>(y) + 0.5f) / 90);
            const auto hit =
                room.engine.ray_caster().closest_hit(camera.ray(film, camera.aspect_ratio, {0, 0}));
            if (!hit) {
                ++v.lost;
                continue;
            }
            if (!hit->front) ++v.backs;
            v.nearest = mir::smaller(v.nearest, glm::length(hit->position - camera.position));
            const std::string& name = room.material(*hit).name;
            const bool of_car = name == "paint" || name == "trim" || name == "rubber" ||
                                name == "metal" || name == "fabric";
            v.car += of_car ? 1.0 / (120 * 90) : 0.0;
            v.lamp += room.material(*hit).emits() ? 1.0 / (120 * 90) : 0.0;
        }
    return v;
}

/// Rays in all directions from `count` random points of a box that escape from the scene.
int escaping(const Room& room, Vec3 low, Vec3 high, int count) {
    mir::Random random = mirtest::test_random(91);
    int lost = 0;
    for (int i = 0; i < count; ++i) {
        const Vec3 u = 0.5f * (mirtest::point_in_cube(random) + 1.0f);
        const Vec3 d = mirtest::direction(random);
        if (!room.engine.ray_caster().closest_hit({low + u * (high - low), d})) ++lost;
    }
    return lost;
}

}  // namespace

TEST_CASE("the cameras of the paper's scenes see the car, and fronts alone") {
    for (const char* name : paper_scenes) {
        CAPTURE(name);
        const View v = view_of(Room(name));
        CHECK(v.car > 0.15);
        CHECK(v.car < 0.6);
        CHECK(v.nearest > 1.0f);
        CHECK(v.lost == 0);
        CHECK(v.backs == 0);
    }
}

TEST_CASE("no ray leaves the rooms of the paper's scenes") {
    CHECK(escaping(Room("car"), {-4.4f, 0.1f, -8.9f}, {4.4f, 3.5f, 5.4f}, 100'000) == 0);
    CHECK(escaping(Room("garage"), {-3.1f, 0.1f, -6.9f}, {3.1f, 2.8f, 4.1f}, 100'000) == 0);
}

TEST_CASE("the camera in the garage sees no lamp, its lamps shine through the door alone") {
    const Room room("garage");
    CHECK(view_of(room).lamp == 0.0);
    // From the next room into the garage: through the opening between door and frame or nowhere.
    mir::Random random = mirtest::test_random(92);
    int through = 0;
    for (int i = 0; i < 100'000; ++i) {
        const Vec3 u = 0.5f * (mirtest::point_in_cube(random) + 1.0f);
        const Vec3 v = 0.5f * (mirtest::point_in_cube(random) + 1.0f);
        const Vec3 lamp(-1.5f + 3.6f * u.x, 2.84f, -5.2f + 0.4f * u.z);
        const Vec3 garage(-3.1f + 6.2f * v.x, 0.1f + 2.7f * v.y, -3.1f + 7.2f * v.z);
        if (!room.engine.visibility().visible(lamp, garage)) continue;
        ++through;
        const bool behind_door = garage.x > 2.15f && garage.z < -2.7f && garage.y < 1.9f;
        REQUIRE_FALSE(behind_door);
        const Vec3 in_wall = lamp + (-3.2f - lamp.z) / (garage.z - lamp.z) * (garage - lamp);
        REQUIRE(in_wall.x > 1.1f);
        REQUIRE(in_wall.x < 2.1f);
        REQUIRE(in_wall.y < 2.1f);
    }
    CHECK(through > 100);
}
