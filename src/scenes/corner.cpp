// SPDX-License-Identifier: MIT
#include "mir/scenes.hpp"

namespace mir::builtin {

Scene corner() {
    Scene s;
    s.name = "corner";
    const std::uint32_t floor = s.add(lambertian("floor", {0.8f, 0.7f, 0.6f}));
    const std::uint32_t wall = s.add(lambertian("wall", {0.6f, 0.7f, 0.8f}));
    const std::uint32_t lamp = s.add(emitter("lamp", {0, 0, 0}, {20.0f, 19.0f, 18.0f}));
    s.place(quad("floor", floor, {-1, 0, 2}, {2, 0, 0}, {0, 0, -2}));
    s.place(quad("wall", wall, {-1, 0, 0}, {2, 0, 0}, {0, 2, 0}));
    s.place(quad("lamp", lamp, {-0.3f, 2.4f, 2.0f}, {0.6f, 0, 0}, {0, -0.4f, 0.4f}));
    s.cameras.push_back(Camera::look_at({0, 1.6f, 4.2f}, {0, 0.75f, 0.4f}, {0, 1, 0}, 0.6f));
    s.cameras.back().name = "edge";
    s.cameras.back().aspect_ratio = 4.0f / 3.0f;
    return s;
}

}  // namespace mir::builtin
