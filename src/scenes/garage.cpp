// SPDX-License-Identifier: MIT
#include "mir/scenes.hpp"
#include "scenes/car.hpp"
#include "scenes/furniture.hpp"
#include "scenes/solids.hpp"

#include <cmath>

namespace mir::builtin {
namespace {

/// The wall at z = -3.2 with a door, opened by `angle`. The frame runs from x = 1.1 to 2.1; the
/// door is hung on the right and opens into the garage.
void place_door_wall(Scene& s, std::uint32_t plaster, std::uint32_t wood, float angle) {
    const auto wall = [&](const char* name, std::uint32_t m, Vec3 low, Vec3 size) {
        s.place(box(name, m, low, {size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}));
    };
    wall("wall left", plaster, {-3.3f, -0.1f, -3.3f}, {4.4f, 3.1f, 0.1f});
    wall("wall right", plaster, {2.1f, -0.1f, -3.3f}, {1.2f, 3.1f, 0.1f});
    // A little thicker than the wall and let into it, so that no ray slips through the joints.
    wall("lintel", wood, {1.05f, 2.1f, -3.32f}, {1.1f, 0.9f, 0.14f});
    const Vec3 across(-std::cos(angle), 0, std::sin(angle));
    const Vec3 through(-std::sin(angle), 0, -std::cos(angle));
    s.place(
        box("door", wood, {2.13f, 0.01f, -3.185f}, 0.98f * across, {0, 2.08f, 0}, 0.04f * through));
    s.place(sphere("door knob", wood,
                   Vec3(2.13f, 1.05f, -3.185f) + 0.89f * across - 0.035f * through, 0.03f, 24, 12));
}

}  // namespace

Scene garage() {
    Scene s;
    s.name = "garage";
    const std::uint32_t plaster = s.add(lambertian("plaster", {0.72f, 0.7f, 0.66f}));
    const std::uint32_t concrete = s.add(lambertian("concrete", {0.45f, 0.44f, 0.42f}));
    const std::uint32_t wood = s.add(lambertian("wood", {0.5f, 0.33f, 0.18f}));
    const std::uint32_t carton = s.add(lambertian("carton", {0.45f, 0.36f, 0.24f}));
    const std::uint32_t lamp = s.add(emitter("lamp", {0, 0, 0}, {400.0f, 345.0f, 265.0f}));
    s.place(inside_out(
        box("shell", plaster, {-3.2f, 0, -7}, {6.4f, 0, 0}, {0, 2.9f, 0}, {0, 0, 11.2f})));
    s.place(
        box("floor", concrete, {-3.3f, -0.1f, -7.1f}, {6.6f, 0, 0}, {0, 0.102f, 0}, {0, 0, 11.4f}));
    place_door_wall(s, plaster, wood, pi * 55.0f / 180.0f);
    place_car(s, turned(pi, {-0.75f, 0.005f, 0.1f}));
    place_shelves(s, wood, carton, {-1.9f, 0.003f, -3.19f});
    s.place(turned_block("crate", carton, {-2.9f, 0.003f, 2.2f}, 0.5f, 0.5f, 0.5f));
    for (const float x : {-1.5f, 0.9f})
        s.place(quad("lamp", lamp, {x, 2.85f, -5.2f}, {1.2f, 0, 0}, {0, 0, 0.4f}));
    s.cameras.push_back(
        Camera::look_at({2.2f, 1.6f, 4.1f}, {-0.25f, 0.75f, 0.0f}, {0, 1, 0}, 0.85f));
    s.cameras.back().name = "garage";
    s.cameras.back().aspect_ratio = 4.0f / 3.0f;
    return s;
}

}  // namespace mir::builtin
