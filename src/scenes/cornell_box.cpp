// SPDX-License-Identifier: MIT
#include "mir/scenes.hpp"
#include "scenes/furniture.hpp"

namespace mir::builtin {

Scene cornell_box(Lamp lamp) {
    Scene s;
    s.name = lamp == Lamp::down ? "cornell-box" : "cornell-inverted";
    const std::uint32_t white = s.add(lambertian("white", {0.725f, 0.71f, 0.68f}));
    const std::uint32_t red = s.add(lambertian("red", {0.63f, 0.065f, 0.05f}));
    const std::uint32_t green = s.add(lambertian("green", {0.14f, 0.45f, 0.091f}));
    const std::uint32_t light = s.add(emitter("light", {0.0f, 0.0f, 0.0f}, {17.0f, 12.0f, 4.0f}));

    s.place(quad("floor", white, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
    s.place(quad("ceiling", white, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}));
    s.place(quad("back wall", white, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0}));
    s.place(quad("left wall", red, {-1, 0, 1}, {0, 0, -2}, {0, 2, 0}));
    s.place(quad("right wall", green, {1, 0, -1}, {0, 0, 2}, {0, 2, 0}));
    s.place(turned_block("tall block", white, {-0.62f, 0, -0.52f}, 0.6f, 1.2f, -0.3f));
    s.place(turned_block("short block", white, {0.0f, 0, 0.05f}, 0.6f, 0.6f, 0.29f));

    const Vec3 x{0.47f, 0, 0};
    const Vec3 z{0, 0, 0.38f};
    if (lamp == Lamp::down)
        s.place(quad("lamp", light, {-0.235f, 1.99f, -0.22f}, x, z));
    else
        s.place(quad("lamp", light, {-0.235f, 1.6f, 0.16f}, x, -z));

    s.cameras.push_back(Camera::look_at({0, 1, 6.8f}, {0, 1, 0}, {0, 1, 0}, 0.3404f));
    s.cameras.back().name = "front";
    s.cameras.back().aspect_ratio = 1.0f;
    return s;
}

}  // namespace mir::builtin
