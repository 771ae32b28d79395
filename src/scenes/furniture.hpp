// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"
#include "mir/scene/shapes.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace mir::builtin {

/// A box on the floor, turned by `angle` about the vertical through `corner`.
inline Mesh turned_block(std::string name, std::uint32_t material, Vec3 corner, float width,
                         float height, float angle) {
    const Vec3 a = width * Vec3(std::cos(angle), 0.0f, -std::sin(angle));
    const Vec3 c = width * Vec3(std::sin(angle), 0.0f, std::cos(angle));
    return box(std::move(name), material, corner, a, {0.0f, height, 0.0f}, c);
}

/// Three boards between two sides, with a carton on each board. `corner` is the one with the
/// smallest coordinates; 1.6 m wide, 1.9 m high.
inline void place_shelves(Scene& s, std::uint32_t wood, std::uint32_t carton, Vec3 corner) {
    for (const float x : {0.0f, 1.56f})
        s.place(box("shelf side", wood, corner + Vec3(x, 0, 0), {0.04f, 0, 0}, {0, 1.9f, 0},
                    {0, 0, 0.4f}));
    for (const float y : {0.5f, 1.1f, 1.7f}) {
        s.place(box("shelf", wood, corner + Vec3(0.04f, y, 0), {1.52f, 0, 0}, {0, 0.03f, 0},
                    {0, 0, 0.4f}));
        s.place(box("carton", carton, corner + Vec3(0.2f + 0.4f * (y - 0.5f), y + 0.03f, 0.03f),
                    {0.5f, 0, 0}, {0, 0.3f, 0}, {0, 0, 0.3f}));
    }
}

}  // namespace mir::builtin
