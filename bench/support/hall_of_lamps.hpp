// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"
#include "mir/scene/shapes.hpp"

namespace mirbench {

/// A hall of 32 x 32 x 4 m with 256 lamps below its ceiling and walls between its bays. Lamps are
/// squares of 10 cm that shine down, or points where `are_points`.
inline mir::Scene hall_of_lamps(bool are_points) {
    using mir::Vec3;
    using mir::builtin::box;
    using mir::builtin::inside_out;
    using mir::builtin::quad;
    mir::Scene scene;
    const std::uint32_t wall = scene.add(mir::lambertian("wall", {0.7f, 0.7f, 0.7f}));
    const std::uint32_t lamp = scene.add(mir::emitter("lamp", {}, {100, 90, 70}));
    scene.place(inside_out(box("hall", wall, {-16, 0, -16}, {32, 0, 0}, {0, 4, 0}, {0, 0, 32})));
    for (int i = -1; i <= 1; ++i)
        for (int k = -2; k < 2; ++k) {
            const auto x = 8.0f * static_cast<float>(i);
            const auto z = 8.0f * static_cast<float>(k) + 1.0f;
            scene.place(box("wall", wall, {x, 0, z}, {0.2f, 0, 0}, {0, 3, 0}, {0, 0, 6}));
        }
    for (int i = 0; i < 256; ++i) {
        const int row = i / 16;
        const Vec3 at(static_cast<float>(2 * (i % 16)) - 15.0f, 3.8f,
                      static_cast<float>(2 * row) - 15.0f);
        if (are_points)
            scene.point_lights.push_back({"bulb", at, {1, 0.9f, 0.7f}});
        else
            scene.place(quad("lamp", lamp, at, {0.1f, 0, 0}, {0, 0, 0.1f}));
    }
    scene.cameras.push_back(mir::Camera::look_at({-14, 3, 14}, {4, 1, -4}, {0, 1, 0}, 1.0f));
    return scene;
}

}  // namespace mirbench
