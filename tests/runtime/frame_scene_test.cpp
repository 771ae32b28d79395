// SPDX-License-Identifier: MIT
#include "mir/runtime/frame_scene.hpp"

#include "mir/scenes.hpp"
#include "support/catch.hpp"

#include <limits>

namespace {

mir::Scene without_camera(mir::Scene scene) {
    scene.cameras.clear();
    return scene;
}

/// A closed box of 4 m x 3 m x 6 m around the origin, its fronts inwards or outwards.
mir::Scene closed_box(bool inwards) {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    mir::Mesh box =
        mir::builtin::box("box", grey, {-2, -1.5f, -3}, {4, 0, 0}, {0, 3, 0}, {0, 0, 6});
    scene.place(inwards ? mir::builtin::inside_out(std::move(box)) : std::move(box));
    return scene;
}

}  // namespace

TEST_CASE("a room without a camera is seen from inside, along its length") {
    const mir::FramedScene framed = mir::frame_scene(closed_box(true), 4.0f / 3.0f);
    CHECK(framed.inside);
    CHECK(std::fabs(framed.camera.position.x) < 2.0f);
    CHECK(std::fabs(framed.camera.position.y) < 1.5f);
    CHECK(std::fabs(framed.camera.position.z) < 3.0f);
    // Away from the wall that it stands at.
    CHECK(framed.camera.back.z * framed.camera.position.z > 0.0f);
    CHECK(framed.camera.up.y > 0.99f);
}

TEST_CASE("a solid thing without a camera is seen from outside, also on a floor") {
    mir::Scene on_floor = closed_box(false);
    on_floor.place(mir::builtin::quad("floor", 0, {-9, -1.5f, 9}, {18, 0, 0}, {0, 0, -18}));
    for (const mir::Scene& scene : {closed_box(false), on_floor}) {
        const mir::FramedScene framed = mir::frame_scene(scene, 1.5f);
        CHECK_FALSE(framed.inside);
        const mir::WorldGeometry geometry(scene);
        CHECK(framed.camera.position == mir::frame_bounds(geometry.bounds(), 1.5f).position);
    }
}

TEST_CASE("the open side of a Cornell box is behind its camera") {
    const mir::FramedScene framed =
        mir::frame_scene(without_camera(mir::builtin::make("cornell-box")), 1.0f);
    CHECK(framed.inside);
    CHECK(framed.camera.back.z > 0.5f);
}

TEST_CASE("a scene without triangles is framed as an empty box") {
    CHECK_FALSE(mir::frame_scene(mir::Scene{}).inside);
    CHECK_THROWS_AS(mir::frame_scene(mir::Scene{}, 0.0f), mir::Error);
}
