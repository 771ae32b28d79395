// SPDX-License-Identifier: MIT
#include "mir/scenes.hpp"
#include "scenes/furniture.hpp"

#include <cmath>

namespace mir::builtin {
namespace {

/// A car of 3.9 m whose nose points to -z: body, cabin and wheels. `rear` is the middle of the
/// ground line behind it. The wheels stand out of the body by 3 cm, so that no two faces coincide.
void place_plain_car(Scene& s, std::uint32_t paint, std::uint32_t tyre, Vec3 rear) {
    s.place(box("car body", paint, rear + Vec3(-0.85f, 0.25f, -3.9f), {1.7f, 0, 0}, {0, 0.6f, 0},
                {0, 0, 3.9f}));
    s.place(box("car cabin", paint, rear + Vec3(-0.7f, 0.85f, -2.5f), {1.4f, 0, 0}, {0, 0.5f, 0},
                {0, 0, 2.0f}));
    for (const float x : {-0.88f, 0.68f})
        for (const float z : {-3.4f, -1.1f})
            s.place(
                box("wheel", tyre, rear + Vec3(x, 0, z), {0.2f, 0, 0}, {0, 0.6f, 0}, {0, 0, 0.6f}));
}

}  // namespace

Scene door_ajar() {
    Scene s;
    s.name = "door-ajar";
    const std::uint32_t plaster = s.add(lambertian("plaster", {0.72f, 0.7f, 0.66f}));
    const std::uint32_t wood = s.add(lambertian("wood", {0.5f, 0.33f, 0.18f}));
    const std::uint32_t paint = s.add(lambertian("paint", {0.55f, 0.09f, 0.08f}));
    const std::uint32_t tyre = s.add(lambertian("tyre", {0.06f, 0.06f, 0.06f}));
    const std::uint32_t carton = s.add(lambertian("carton", {0.45f, 0.36f, 0.24f}));
    const std::uint32_t lamp = s.add(emitter("lamp", {0, 0, 0}, {220.0f, 190.0f, 150.0f}));

    s.place(inside_out(box("shell", plaster, {-3, 0, -6}, {6, 0, 0}, {0, 3, 0}, {0, 0, 12})));
    s.place(box("wall left", plaster, {-3, 0, -0.1f}, {4, 0, 0}, {0, 3, 0}, {0, 0, 0.1f}));
    s.place(box("wall right", plaster, {1.9f, 0, -0.1f}, {1.1f, 0, 0}, {0, 3, 0}, {0, 0, 0.1f}));
    // A little thicker than the wall and let into it, so that no ray slips through the joints.
    s.place(box("lintel", wood, {0.9f, 2.1f, -0.12f}, {1.1f, 0, 0}, {0, 0.9f, 0}, {0, 0, 0.14f}));

    // Hung on the right, opened by 25 degrees towards the camera.
    const float angle = pi * 25.0f / 180.0f;
    const Vec3 across = Vec3(-std::cos(angle), 0, std::sin(angle));
    const Vec3 through = Vec3(-std::sin(angle), 0, -std::cos(angle));
    s.place(box("door", wood, Vec3(1.9f, 0, 0), 0.9f * across, {0, 2.08f, 0}, 0.04f * through));

    place_plain_car(s, paint, tyre, {-1.3f, 0, 4.9f});
    place_shelves(s, wood, carton, {-1.2f, 0, 0});
    s.place(turned_block("crate", carton, {0.35f, 0, 1.9f}, 0.5f, 0.5f, 0.5f));
    s.place(turned_block("table", wood, {-1.2f, 0, -2.6f}, 0.9f, 0.75f, 0.2f));
    for (const float x : {-1.9f, 0.7f})
        s.place(quad("lamp", lamp, {x, 2.6f, -3.0f}, {1.2f, 0, 0}, {0, 0, -0.25f}));

    s.cameras.push_back(Camera::look_at({2.4f, 1.6f, 5.6f}, {-0.4f, 0.9f, 0.8f}, {0, 1, 0}, 0.95f));
    s.cameras.back().name = "garage";
    s.cameras.back().aspect_ratio = 4.0f / 3.0f;
    return s;
}

}  // namespace mir::builtin
