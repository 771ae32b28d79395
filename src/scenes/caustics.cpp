// SPDX-License-Identifier: MIT
#include "mir/scenes.hpp"
#include "scenes/glass.hpp"

namespace mir::builtin {

Scene caustics() {
    Scene s;
    s.name = "caustics";
    const std::uint32_t table = s.add(lambertian("table", {0.7f, 0.66f, 0.6f}));
    const std::uint32_t wall = s.add(lambertian("wall", {0.35f, 0.42f, 0.55f}));
    const std::uint32_t gold = s.add(mirror("gold", {1.0f, 0.78f, 0.34f}));
    const std::uint32_t glass = s.add(body_glass("glass", 1.5f));
    const std::uint32_t lamp = s.add(emitter("lamp", {0, 0, 0}, {640.0f, 600.0f, 520.0f}));

    s.place(quad("table", table, {-0.7f, 0, 0.6f}, {1.4f, 0, 0}, {0, 0, -1.1f}));
    s.place(quad("wall", wall, {-0.7f, 0, -0.5f}, {1.4f, 0, 0}, {0, 0.8f, 0}));
    s.place(turned_solid("ring", gold, {-0.16f, 0.0005f, 0.08f},
                         {{{0.12f, 0}, {0.12f, 0.05f}},
                          {{0.12f, 0.05f}, {0.116f, 0.05f}},
                          {{0.116f, 0.05f}, {0.116f, 0}},
                          {{0.116f, 0}, {0.12f, 0}}},
                         128));
    s.place(sphere("ball", glass, {0.16f, 0.0705f, 0.0f}, 0.07f, 48, 24));
    const Vec3 place(0.45f, 0.6f, -0.3f);
    s.place(disc("lamp", lamp, place, glm::normalize(Vec3(0, 0, 0.05f) - place),
                 glm::normalize(Vec3(0.35f, 0, 0.45f)), 0.03f, 24));

    s.cameras.push_back(
        Camera::look_at({-0.05f, 0.62f, 0.95f}, {-0.02f, 0.03f, 0.06f}, {0, 1, 0}, 0.62f));
    s.cameras.back().name = "table";
    s.cameras.back().aspect_ratio = 4.0f / 3.0f;
    return s;
}

}  // namespace mir::builtin
