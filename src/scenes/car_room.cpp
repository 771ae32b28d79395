// SPDX-License-Identifier: MIT
#include "mir/scenes.hpp"
#include "scenes/car.hpp"
#include "scenes/car_materials.hpp"
#include "scenes/wire_fence.hpp"

namespace mir::builtin {
namespace {

/// Two rooms in one shell, 3.6 m high. x is from -4.5 to 4.5, z from -9 to 5.5: a plane at z = -4.5
/// leaves a passage of 0.9 m beside the wall on the right. Lamps as in sphere_room(): the main one
/// above the car, turned down or up, the other behind the plane.
void place_rooms(Scene& s, Lamp lamp) {
    const std::uint32_t wall = s.add(lambertian("wall", {0.7f, 0.68f, 0.65f}));
    const std::uint32_t floor = s.add(lambertian("floor", {0.42f, 0.41f, 0.4f}));
    const std::uint32_t plane = s.add(lambertian("plane", {0.45f, 0.52f, 0.6f}));
    const std::uint32_t main = s.add(emitter("main lamp", {0, 0, 0}, {15.0f, 14.2f, 12.6f}));
    const std::uint32_t far = s.add(emitter("far lamp", {0, 0, 0}, {40.0f, 34.0f, 24.0f}));
    s.place(inside_out(box("shell", wall, {-4.5f, 0, -9}, {9, 0, 0}, {0, 3.6f, 0}, {0, 0, 14.5f})));
    s.place(
        box("floor", floor, {-4.6f, -0.1f, -9.1f}, {9.2f, 0, 0}, {0, 0.102f, 0}, {0, 0, 14.7f}));
    s.place(box("plane", plane, {-4.6f, -0.1f, -4.6f}, {8.2f, 0, 0}, {0, 3.8f, 0}, {0, 0, 0.1f}));
    if (lamp == Lamp::down)
        s.place(quad("main lamp", main, {-1.5f, 3.55f, -1}, {3, 0, 0}, {0, 0, 2}));
    else
        s.place(quad("main lamp", main, {-1.5f, 2.9f, 1}, {3, 0, 0}, {0, 0, -2}));
    s.place(quad("far lamp", far, {-1, 3.55f, -7.8f}, {2, 0, 0}, {0, 0, 2}));
}

}  // namespace

Scene car_room(Lamp lamp) {
    Scene s;
    s.name = lamp == Lamp::down ? "car" : "car-indirect";
    place_rooms(s, lamp);
    place_car(s, turned(pi + 0.55f, {0.0f, 0.005f, 0.0f}));
    s.cameras.push_back(
        Camera::look_at({-0.6f, 1.6f, 5.3f}, {0.0f, 0.62f, 0.0f}, {0, 1, 0}, 0.72f));
    s.cameras.back().name = "room";
    s.cameras.back().aspect_ratio = 4.0f / 3.0f;
    return s;
}

Scene car_grille(Lamp lamp) {
    Scene s = car_room(lamp);
    s.name = lamp == Lamp::down ? "car-grille" : "car-grille-indirect";
    const std::uint32_t wire = s.add(coated("wire", {0.3f, 0.3f, 0.32f}, 0.6f, 0.3f));
    const Vec3 low(-2.1f, 0.03f, -2.5f);
    const Vec3 x(4.2f, 0, 0);
    const Vec3 y(0, 2.2f, 0);
    const Vec3 z(0, 0, 5.0f);
    s.place(fence("fence back", wire, {low, x, y}));
    // Wires of neighbours must not coincide where they meet.
    const Vec3 apart(0, 0, 0.03f);
    s.place(fence("fence left", wire, {low + apart, z, y}));
    s.place(fence("fence right", wire, {low + x + apart, z, y}));
    s.place(fence("fence top", wire, {low + y + Vec3(0, 0.02f, 0), z, x}));
    return s;
}

}  // namespace mir::builtin
