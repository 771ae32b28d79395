// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace mir::detail {

/// Words on what the readers count. The reader's code and tests/io/features say what it does; the
/// words here say how that looks.
struct VisibleEffect {
    std::string_view pattern;  ///< name of the feature; a star in it stands for any text
    std::string_view words;

    [[nodiscard]] constexpr bool is_of(std::string_view feature) const {
        const std::size_t star = pattern.find('*');
        if (star == std::string_view::npos) return feature == pattern;
        const std::string_view front = pattern.substr(0, star);
        const std::string_view back = pattern.substr(star + 1);
        return feature.size() >= front.size() + back.size() && feature.starts_with(front) &&
               feature.ends_with(back);
    }
};

inline constexpr std::string_view effect_of_unknown_feature = "drawn as if the file did not say it";

/// Of any format. In this and the following lists the first that fits counts.
inline constexpr std::array shared_effects = {
    VisibleEffect{"* outside 0..1 (clamped)", "the nearest of 0 and 1 is taken"},
    VisibleEffect{"image *", "surfaces that use this image go without it"},
    VisibleEffect{"face of fewer than three corners", "it is not drawn"},
};

inline constexpr std::array gltf_material_effects = {
    VisibleEffect{"alphaMode *", "what should be see-through is solid, in its own colour"},
    VisibleEffect{"KHR_materials_volume_scatter",
                  "wax, milk and skin look solid: light does not spread below their surface"},
    VisibleEffect{"KHR_materials_dispersion", "glass shows no rainbow colours"},
    VisibleEffect{"KHR_materials_volume of diffuse transmission",
                  "light that goes through diffusely takes no colour inside of the body"},
    VisibleEffect{"KHR_materials_clearcoat on glass", "the coat of the glass is missing"},
    VisibleEffect{"KHR_materials_sheen", "cloth lacks its soft, bright rim"},
    VisibleEffect{"KHR_materials_iridescence", "thin films show no rainbow colours"},
    VisibleEffect{"KHR_materials_anisotropy",
                  "highlights are round, not drawn out as on brushed metal"},
    VisibleEffect{"KHR_materials_variants",
                  "each surface has its usual material; the variants are not shown"},
    VisibleEffect{"KHR_materials_specular specularColorFactor",
                  "reflections of what is no metal are white, not tinted"},
    VisibleEffect{"KHR_materials_ior of 0 (taken as 1.5)",
                  "reflections are those of plastic or glass"},
    VisibleEffect{"KHR_materials_pbrSpecularGlossiness specularFactor",
                  "reflections are those of plastic: metals look dark"},
    VisibleEffect{"KHR_materials_*", "drawn as if the material did not have it"},
    VisibleEffect{"COLOR_0 of an unlit material",
                  "the surface has the colour of its material, without those of its vertices"},
    VisibleEffect{"alpha of COLOR_0 in a mask", "holes that this alpha cuts are filled"},
};

inline constexpr std::array gltf_texture_effects = {
    VisibleEffect{"texture occlusionTexture",
                  "its painted shade is left out; light and shade are computed"},
    VisibleEffect{"texture baseColorTexture*",
                  "the surface has one colour where this image belongs"},
    VisibleEffect{"texture metallicRoughnessTexture*",
                  "gloss and metal are the same all over the surface"},
    VisibleEffect{"texture normalTexture*", "the surface lacks the fine relief of this image"},
    VisibleEffect{"texture emissiveTexture*",
                  "all of the surface shines, where this image lets parts of it shine"},
    VisibleEffect{"texture transmissionTexture*", "it is equally clear all over the surface"},
    VisibleEffect{"texture diffuseTransmissionTexture*",
                  "as much light goes through all over the surface"},
    VisibleEffect{"texture diffuseTransmissionColorTexture*",
                  "the light that goes through has one colour all over the surface"},
    VisibleEffect{"texture clearcoatTexture*", "the coat is the same all over the surface"},
    VisibleEffect{"texture clearcoatRoughnessTexture*",
                  "the coat is equally sharp all over the surface"},
    VisibleEffect{"texture clearcoatNormalTexture", "the coat lacks the fine relief of this image"},
    VisibleEffect{"texture thicknessTexture", "bodies are as thick as their surfaces are apart"},
    VisibleEffect{"texture specularTexture", "reflections are equally strong all over the surface"},
    VisibleEffect{"texture specularColorTexture",
                  "reflections of what is no metal are white, not tinted"},
    VisibleEffect{"texture diffuseTexture",
                  "the surface lacks the colours of this image, unless its fallback has them"},
    VisibleEffect{"texture specularGlossinessTexture", "gloss does not vary as this image says"},
    VisibleEffect{"textured mesh without texture coordinates",
                  "the surface has one colour, that of a corner of its image"},
};

inline constexpr std::string_view no_surroundings =
    "no light comes from all around, and the background is black; --environment gives one";
inline constexpr std::string_view incomplete_color =
    "vertices go without colour: one of its three numbers is missing";
inline constexpr std::string_view incomplete_normal =
    "surfaces look flat: one of the three numbers of normals is missing";

/// Of glTF and of PLY: meshes, lights and what is around them.
inline constexpr std::array scene_effects = {
    VisibleEffect{"primitive of points", "points are not drawn"},
    VisibleEffect{"primitive of lines", "lines are not drawn"},
    VisibleEffect{"primitive without *", "this part of the mesh is not drawn"},
    VisibleEffect{"incomplete triangle at the end of a primitive",
                  "the corners that are left over are not drawn"},
    VisibleEffect{"normal without a direction (mesh counted once)",
                  "the surface looks flat, not rounded, at these corners"},
    VisibleEffect{"morph target of COLOR_*", "the blended shape keeps its first colours"},
    VisibleEffect{"morph target of TEXCOORD_*", "images do not move with the blended shape"},
    VisibleEffect{"skin", "the mesh is not bent by its skeleton, and may lie elsewhere"},
    VisibleEffect{"animation", "nothing moves: all is drawn as the file has it at rest"},
    VisibleEffect{"MSFT_lod", "the finest version is drawn, at any distance"},
    VisibleEffect{"KHR_draco_mesh_compression",
                  "the mesh that is stored beside the compressed one is drawn"},
    VisibleEffect{"camera of type *", "no picture can be taken with this camera"},
    VisibleEffect{"range of a light", "the lamp shines beyond its range"},
    VisibleEffect{"light of type *", "the lamp does not shine"},
    VisibleEffect{"EXT_lights_ies", "these lamps do not shine"},
    VisibleEffect{"EXT_lights_image_based", no_surroundings},
    VisibleEffect{"environment", no_surroundings},
    VisibleEffect{"PLY vertex property 'red'", incomplete_color},
    VisibleEffect{"PLY vertex property 'green'", incomplete_color},
    VisibleEffect{"PLY vertex property 'blue'", incomplete_color},
    VisibleEffect{"PLY vertex property 'nx'", incomplete_normal},
    VisibleEffect{"PLY vertex property 'ny'", incomplete_normal},
    VisibleEffect{"PLY vertex property 'nz'", incomplete_normal},
    VisibleEffect{"PLY vertex property 'alpha'", "what should be see-through is solid"},
    VisibleEffect{"PLY vertex property *", "this value of the vertices is not shown"},
    VisibleEffect{"PLY face property *", "this value of the faces is not shown"},
    VisibleEffect{"PLY element *", "it is not drawn"},
};

inline constexpr std::array obj_effects = {
    VisibleEffect{"lines", "lines are not drawn"},
    VisibleEffect{"points", "points are not drawn"},
    VisibleEffect{"material library * (not found)", "its materials are missing"},
    VisibleEffect{"use of a material that no library has",
                  "the surface is matt and light grey, or has the colours of its vertices"},
    VisibleEffect{"material defined twice (the first is used)",
                  "surfaces have the first of the two"},
    VisibleEffect{"face with normals at some corners alone (shaded flat)",
                  "these faces look flat, not rounded"},
    VisibleEffect{"smoothing groups without normals (shaded flat)",
                  "round surfaces show their facets"},
    VisibleEffect{"textured corner without texture coordinates",
                  "a corner of the image lies there, drawn out over the face"},
    VisibleEffect{"characters behind a number", "the number before them is taken"},
    VisibleEffect{"statement 'curv*'", "curves are not drawn"},
    VisibleEffect{"statement 'surf'", "curved surfaces are not drawn"},
    VisibleEffect{"statement *", "drawn as if the line were missing"},
    VisibleEffect{"Tf without a model of glass", "the surface lets no coloured light through"},
    VisibleEffect{"illum 10 (shadows on what is not seen)",
                  "the surface is seen, not only the shadows on it"},
    VisibleEffect{"colour of Ks (its mean is used)", "reflections are white, not tinted"},
    VisibleEffect{"map_d *", "holes that this image cuts are filled"},
};

inline constexpr std::string_view no_relief = "the surface lacks the fine relief of this image";
inline constexpr std::string_view round_highlights =
    "highlights are round, not drawn out as on brushed metal";

inline constexpr std::array mtl_effects = {
    VisibleEffect{"MTL option '-halo'", "it is equally opaque at its rim"},
    VisibleEffect{"MTL option *", "the image is used without this option"},
    VisibleEffect{"MTL '* without a value", "drawn as if the line were missing"},
    VisibleEffect{"MTL '* xyz'", "this colour is left out"},
    VisibleEffect{"MTL '* spectral'", "this colour is left out"},
    VisibleEffect{"MTL 'bump'", no_relief},
    VisibleEffect{"MTL 'map_Bump'", no_relief},
    VisibleEffect{"MTL 'map_bump'", no_relief},
    VisibleEffect{"MTL 'disp'", no_relief},
    VisibleEffect{"MTL 'decal'", "the picture on the surface is missing"},
    VisibleEffect{"MTL 'refl'", "reflections are of the scene, not of this image"},
    VisibleEffect{"MTL 'map_Ks'", "reflections are equally strong all over the surface"},
    VisibleEffect{"MTL 'map_Ns'", "reflections are equally sharp all over the surface"},
    VisibleEffect{"MTL 'map_Pr'", "reflections are equally sharp all over the surface"},
    VisibleEffect{"MTL 'map_Pm'", "the surface is equally metallic all over"},
    VisibleEffect{"MTL 'Ps'", "cloth lacks its soft, bright rim"},
    VisibleEffect{"MTL 'map_Ps'", "cloth lacks its soft, bright rim"},
    VisibleEffect{"MTL 'aniso'", round_highlights},
    VisibleEffect{"MTL 'anisor'", round_highlights},
    VisibleEffect{"MTL *", "drawn as if the line were missing"},
};

inline constexpr std::array<std::span<const VisibleEffect>, 6> visible_effect_lists = {
    shared_effects, gltf_material_effects, gltf_texture_effects,
    scene_effects,  obj_effects,           mtl_effects};

}  // namespace mir::detail
