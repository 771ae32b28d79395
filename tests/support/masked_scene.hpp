// SPDX-License-Identifier: MIT
#pragma once

#include "support/textured_scene.hpp"

namespace mirtest {

/// Every other texel is a hole.
inline mir::TextureImage checkerboard(std::uint32_t edge) {
    mir::TextureImage image{"checkerboard", edge, edge, {}};
    for (std::uint32_t i = 0; i < edge * edge; ++i)
        image.texels.push_back(texel(255, 255, 255, (i % edge + i / edge) % 2 == 0 ? 255 : 0));
    return image;
}

/// Hangs a parallelogram of a material into a scene, a checkerboard of `edge` x `edge` fields half
/// of which are holes.
inline void hang_curtain(mir::Scene& scene, mir::Material m, std::uint32_t edge, mir::Vec3 corner,
                         mir::Vec3 e1, mir::Vec3 e2) {
    m.textures.base_color = texture_of(static_cast<std::uint32_t>(scene.images.size()));
    m.textures.base_color.nearest = true;
    m.alpha_cutoff = 0.5f;
    scene.images.push_back(checkerboard(edge));
    mir::Mesh mesh;
    mesh.name = "curtain";
    mesh.positions = {corner, corner + e1, corner + e1 + e2, corner + e2};
    mesh.texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material = scene.add(std::move(m));
    scene.place(std::move(mesh));
}

}  // namespace mirtest
