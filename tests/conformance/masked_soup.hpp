// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"
#include "support/textured_scene.hpp"

namespace mirtest {

/// A square picture of grey of random alpha.
inline mir::TextureImage random_alpha(std::uint32_t edge, mir::Random& random) {
    mir::TextureImage image{"alpha", edge, edge, {}};
    for (std::uint32_t i = 0; i < edge * edge; ++i)
        image.texels.push_back(texel(99, 99, 99, static_cast<std::uint32_t>(random.next() * 256)));
    return image;
}

inline mir::Material masked(float alpha, float cutoff, const mir::Texture& texture = {}) {
    mir::Material m = mir::lambertian("masked", {0.5f, 0.5f, 0.5f});
    m.alpha = alpha;
    m.alpha_cutoff = cutoff;
    m.textures.base_color = texture;
    return m;
}

/// One material without a mask, one that cuts everything away, and three with random images, looked
/// up in each way there is.
inline std::vector<mir::Material> soup_materials() {
    mir::Texture nearest = texture_of(0);
    nearest.nearest = true;
    mir::Texture bilinear = texture_of(1);
    bilinear.wrap_u = mir::Wrap::mirror;
    bilinear.wrap_v = mir::Wrap::clamp;
    bilinear.u_axis = {0.6f, 0.8f};
    bilinear.v_axis = {-1.6f, 1.2f};
    bilinear.offset = {0.3f, -0.2f};
    return {masked(1.0f, 0.0f), masked(0.4f, 0.5f), masked(1.0f, 0.5f, nearest),
            masked(0.9f, 0.45f, nearest), masked(1.0f, 0.5f, bilinear)};
}

/// Materials with holes, blended ones and thin glass, plain and with random images.
inline std::vector<mir::Material> see_through_materials() {
    std::vector<mir::Material> materials = soup_materials();
    mir::Material veil = masked(0.6f, 0.0f);
    veil.is_blended = true;
    mir::Material lace = masked(0.9f, 0.0f, texture_of(0));
    lace.is_blended = true;
    mir::Material glass = masked(1.0f, 0.0f);
    glass.base_color = {0.9f, 0.95f, 0.8f};
    glass.specular = 1.0f;
    glass.roughness = 0.0f;
    glass.transmission = 0.9f;
    mir::Material stained = glass;
    stained.textures.base_color = texture_of(1);
    stained.textures.metallic_roughness = texture_of(0);
    mir::Material broken = masked(1.0f, 0.5f, texture_of(1));
    broken.roughness = 0.0f;
    broken.transmission = 0.7f;
    for (mir::Material& m : std::vector{veil, lace, glass, stained, broken})
        materials.push_back(std::move(m));
    return materials;
}

/// triangle_soup() of the materials `materials`, by turns, whose corners have random texture
/// coordinates.
inline World masked_soup(std::uint32_t count, std::uint64_t index,
                         const std::vector<mir::Material>& materials) {
    const World plain = triangle_soup(count, index);
    mir::Random random = test_random(index);
    mir::Scene scene;
    scene.materials = materials;
    for (std::uint32_t edge : {8u, 5u}) scene.images.push_back(random_alpha(edge, random));
    for (std::uint32_t i = 0; i < count; ++i) {
        mir::Mesh mesh;
        mesh.material = i % static_cast<std::uint32_t>(materials.size());
        mesh.triangles = {{0, 1, 2}};
        for (std::uint32_t k = 0; k < 3; ++k) {
            mesh.positions.push_back(plain.geometry.corner(i, k));
            mesh.texture_coordinates.push_back(3.0f * random.next_2d() - mir::Vec2(1.0f));
        }
        scene.place(std::move(mesh));
    }
    return World(std::move(scene));
}

}  // namespace mirtest
