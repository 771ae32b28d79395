// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace mirtest {

/// A texel of these codes.
inline std::uint32_t texel(std::uint32_t r, std::uint32_t g, std::uint32_t b,
                           std::uint32_t a = 255) {
    return r | g << 8 | b << 16 | a << 24;
}

inline mir::Texture texture_of(std::uint32_t image) {
    mir::Texture t;
    t.image = image;
    return t;
}

/// One triangle in the plane z = 0, front towards +z, whose texture coordinates are x and 1 - y:
/// the image stands upright. Image 0 is 2 x 2: red, green above blue, white.
inline mir::Scene textured_triangle(mir::Material material) {
    mir::Scene scene;
    scene.images.push_back(
        {"rgbw",
         2,
         2,
         {texel(255, 0, 0), texel(0, 255, 0), texel(0, 0, 255), texel(255, 255, 255)}});
    scene.add(std::move(material));
    mir::Mesh mesh;
    mesh.name = "triangle";
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    mesh.triangles = {{0, 1, 2}};
    for (mir::Vec3 p : mesh.positions) mesh.texture_coordinates.emplace_back(p.x, 1.0f - p.y);
    scene.place(std::move(mesh));
    return scene;
}

}  // namespace mirtest
