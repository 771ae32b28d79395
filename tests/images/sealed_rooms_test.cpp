// SPDX-License-Identifier: MIT
//
// Closed rooms in which nothing shines, with all light outside: not a ray may pass their edges. By
// the library's own structures; what Embree leaks is in tests/cpu/embree_leaks_test.cpp.
#include "images/support.hpp"
#include "mir/scene/shapes.hpp"
#include "support/catch.hpp"
#include "support/closed_rooms.hpp"

#include <algorithm>

namespace {

using mir::Vec3;

/// Lights of every kind around a room of that size.
void light_from_outside(mir::Scene& scene, Vec3 centre, float size) {
    const auto lamp = scene.add(mir::emitter("lamp", {}, {10, 10, 10}));
    const Vec3 above = centre + 1.5f * size * Vec3(-1, 1, -1);
    scene.place(mir::builtin::quad("lamp", lamp, above, {0, 0, size}, {size, 0, 0}));
    const float intensity = 10.0f * size * size;
    scene.point_lights.push_back(
        {"bulb", centre + 2.0f * size * Vec3(1, 1, 0.5f), mir::Rgb{1, 1, 1} * intensity});
    scene.directional_lights.push_back(
        {"sun", glm::normalize(Vec3(-1, -2, -1)), {3.0f, 3.0f, 3.0f}});
    scene.directional_lights.push_back({"low sun", {1, 0, 0}, {3.0f, 3.0f, 3.0f}});
}

/// A room of two metres, seen so that edges of its triangles lie in the middles of pixels. An open
/// one lacks a triangle.
mir::Scene box_room(bool open) {
    mir::Scene scene;
    const auto grey = scene.add(mir::lambertian("grey", {0.6f, 0.6f, 0.6f}));
    mir::Mesh room = mir::builtin::inside_out(
        mir::builtin::box("room", grey, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}));
    if (open) room.triangles.pop_back();
    scene.place(std::move(room));
    light_from_outside(scene, Vec3(0.0f), 2.0f);
    scene.cameras.push_back(mir::Camera::look_at({0, 0, 0.9f}, {0, 0, -1}, {0, 1, 0}, 1.4f));
    return scene;
}

/// The inside of a closed ball, rough or smooth, seen towards one of its vertices.
mir::Scene ball_room(const mirtest::BallShape& ball) {
    mir::Scene scene = ball.world().scene;
    const Vec3 vertex = scene.meshes[0].positions[scene.meshes[0].positions.size() / 2];
    light_from_outside(scene, ball.centre(), ball.scale);
    scene.cameras.push_back(mir::Camera::look_at(ball.centre(), vertex, {0.3f, 1, 0.2f}, 1.4f));
    return scene;
}

/// Pixels that are not exactly black.
std::size_t lit_pixels(const mir::Scene& scene, const mir::RenderSettings& settings) {
    const mir::RenderResult picture = mirtest::render(scene, settings);
    const auto pixels = picture.beauty.pixels();
    return static_cast<std::size_t>(
        std::count_if(pixels.begin(), pixels.end(), [](mir::Rgb p) { return !(p == mir::Rgb{}); }));
}

/// Of pictures by rays and by shafts, with VPLs of lamps outside, by paths, and from discs.
std::size_t lit_pixels(const mir::Scene& scene, mir::Acceleration acceleration) {
    mir::RenderSettings s = mirtest::small_settings(65, 64);
    s.sampler = mir::SamplerKind::instant_radiosity;
    s.acceleration = acceleration;
    s.path.samples = 4;
    std::size_t lit = 0;
    for (const char* scheduler : {"cpu", "cpu-blocks"}) {
        s.scheduler = scheduler;
        lit += lit_pixels(scene, s);
    }
    s.integrator = mir::Integrator::path;
    lit += lit_pixels(scene, s);
    s.integrator = mir::Integrator::micro;
    s.micro.surfels = 256;
    s.micro.surfel_rays = 8;
    s.micro.gather.rays = 16;
    return lit + lit_pixels(scene, s);
}

}  // namespace

TEST_CASE("a closed room with all light outside is exactly black") {
    for (const auto acceleration : {mir::Acceleration::kd_tree, mir::Acceleration::bvh}) {
        CAPTURE(int(acceleration));
        CHECK(lit_pixels(box_room(false), acceleration) == 0);
        // Else the light would not reach the room at all.
        CHECK(lit_pixels(box_room(true), acceleration) > 1000);
        for (const mirtest::BallShape& ball : mirtest::leak_balls()) {
            INFO(ball.name());
            CHECK(lit_pixels(ball_room(ball), acceleration) == 0);
        }
    }
}
