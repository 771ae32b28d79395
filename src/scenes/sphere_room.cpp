// SPDX-License-Identifier: MIT
#include "mir/scenes.hpp"
#include "scenes/glass.hpp"

namespace mir::builtin {

Scene sphere_room(Lamp lamp) {
    Scene s;
    s.name = lamp == Lamp::down ? "sphere" : "sphere-indirect";
    const std::uint32_t wall = s.add(lambertian("wall", {0.7f, 0.68f, 0.65f}));
    const std::uint32_t warm = s.add(lambertian("warm wall", {0.6f, 0.3f, 0.2f}));
    const std::uint32_t ball = s.add(lambertian("ball", {0.35f, 0.45f, 0.65f}));
    const std::uint32_t main = s.add(emitter("main lamp", {0, 0, 0}, {18.0f, 17.0f, 15.0f}));
    const std::uint32_t far = s.add(emitter("far lamp", {0, 0, 0}, {40.0f, 34.0f, 24.0f}));

    // Two rooms in one shell: z from -8 to 4, the plane at z = -3 with a passage of 0.9 m.
    const Vec3 low{-4, 0, -8};
    s.place(inside_out(box("shell", wall, low, {8, 0, 0}, {0, 4, 0}, {0, 0, 12})));
    s.place(box("plane", warm, {-4, 0, -3.1f}, {7.1f, 0, 0}, {0, 4, 0}, {0, 0, 0.1f}));
    s.place(box("plinth", wall, {-0.9f, 0, -0.9f}, {1.8f, 0, 0}, {0, 0.4f, 0}, {0, 0, 1.8f}));
    s.place(sphere("sphere", ball, {0, 1.4f, 0}, 1.0f, 44, 22));

    if (lamp == Lamp::down)
        s.place(quad("main lamp", main, {-1, 3.9f, -1}, {2, 0, 0}, {0, 0, 2}));
    else
        s.place(quad("main lamp", main, {-1, 3.2f, 1}, {2, 0, 0}, {0, 0, -2}));
    s.place(quad("far lamp", far, {-1, 3.9f, -6.5f}, {2, 0, 0}, {0, 0, 2}));

    s.cameras.push_back(
        Camera::look_at({-2.6f, 2.1f, 3.7f}, {0.4f, 1.3f, -1.0f}, {0, 1, 0}, 0.95f));
    s.cameras.back().name = "room";
    s.cameras.back().aspect_ratio = 4.0f / 3.0f;
    return s;
}

Scene sphere_behind_glass() {
    Scene s = sphere_room(Lamp::down);
    s.name = "sphere-behind-glass";
    const std::uint32_t glass = s.add(body_glass("glass", 1.5f));
    s.place(
        box("lampshade", glass, {-1.2f, 3.65f, -1.2f}, {2.4f, 0, 0}, {0, 0.33f, 0}, {0, 0, 2.4f}));
    s.place(inside_out(box("lampshade, inside", glass, {-1.18f, 3.67f, -1.18f}, {2.36f, 0, 0},
                           {0, 0.29f, 0}, {0, 0, 2.36f})));
    return s;
}

}  // namespace mir::builtin
