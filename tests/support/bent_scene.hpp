// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"
#include "mir/core/random.hpp"
#include "mir/scene/scene.hpp"
#include "support/textured_scene.hpp"

#include <cmath>
#include <utility>

namespace mirtest {

/// A map of 8 x 8 normals, one a texel, that turn by up to `most` radians any way.
inline mir::TextureImage bumps(float most, std::uint64_t index) {
    mir::Random random = test_random(index);
    const auto code = [](float x) {
        return static_cast<std::uint32_t>(std::lround(127.5f * (x + 1.0f)));
    };
    mir::TextureImage image{"bumps", 8, 8, {}};
    for (int i = 0; i < 64; ++i) {
        const float turn = most * random.next();
        const float round = 2.0f * mir::pi * random.next();
        image.texels.push_back(texel(code(std::sin(turn) * std::cos(round)),
                                     code(std::sin(turn) * std::sin(round)), code(std::cos(turn))));
    }
    return image;
}

/// The scene with bumps() on all surfaces, as fine as a tenth of a metre or so.
inline mir::Scene with_bumps(mir::Scene scene, float most, std::uint64_t index) {
    const auto image = static_cast<std::uint32_t>(scene.images.size());
    scene.images.push_back(bumps(most, index));
    for (mir::Material& m : scene.materials) m.textures.normal = texture_of(image);
    for (mir::Mesh& mesh : scene.meshes) {
        mesh.texture_coordinates.clear();
        for (const mir::Vec3 p : mesh.positions)
            mesh.texture_coordinates.emplace_back(p.x + 0.37f * p.y, p.z + 0.61f * p.y);
    }
    return scene;
}

}  // namespace mirtest
