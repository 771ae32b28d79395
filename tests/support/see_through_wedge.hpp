// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/shapes.hpp"
#include "support/textured_scene.hpp"

namespace mirtest {

/// Two panes across a Wedge. They send nothing back.
inline void add_panes(mir::Scene& scene) {
    mir::Material pane = mir::lambertian("pane", {0, 0, 0});
    pane.is_blended = true;
    pane.alpha = 0.6f;
    const std::uint32_t m = scene.add(pane);
    scene.place(mir::builtin::quad("low", m, {-1.2f, 0.15f, 1}, {2.4f, 0.02f, 0}, {0, 0.01f, -2}));
    scene.place(mir::builtin::quad("steep", m, {0.1f, 0, 1}, {0.05f, 0.3f, 0}, {0, 0, -2}));
}

/// Makes the lamps of a Wedge veils with holes, or panes of glass.
inline void see_through_lamps(mir::Scene& scene, bool is_glass) {
    scene.images.push_back({"holes",
                            2,
                            2,
                            {texel(255, 90, 10, 0), texel(200, 9, 99, 102), texel(9, 255, 9, 204),
                             texel(250, 250, 250, 255)}});
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        mir::Material& m = scene.materials[i];
        if (!m.emits()) continue;
        m.is_blended = !is_glass;
        m.alpha = 0.8f;
        m.textures.base_color = is_glass ? mir::Texture{} : texture_of(0);
        m.transmission = is_glass ? 0.6f : 0.0f;
        m.roughness = is_glass ? 0.0f : m.roughness;
        for (mir::Mesh& mesh : scene.meshes)
            if (mesh.material == i) mesh.texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    }
}

}  // namespace mirtest
