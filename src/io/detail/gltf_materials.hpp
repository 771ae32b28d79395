// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_parse_materials.hpp"
#include "io/detail/gltf_textures.hpp"
#include "mir/core/number_text.hpp"
#include "mir/scene/material.hpp"

#include <tiny_gltf.h>

#include <string>

namespace mir::detail {

/// Converts the materials of a file and counts what they do not get.
class GltfMaterials {
 public:
    GltfMaterials(const tinygltf::Model& model, GltfImages& images, SceneReport& report)
        : model_(model), report_(report), textures_(model, images, report) {}

    /// Material `index` of the file.
    /// @throws Error(invalid_input) on values that mean nothing, such as negative emission.
    [[nodiscard]] Material convert(std::size_t index) {
        set_ = -1;
        const tinygltf::Material& from = model_.materials[index];
        place_ = gltf_place("material", index, from.name);
        Material to;
        to.name = from.name;
        to.emits_from_both_sides = from.doubleSided;
        to.light_group = light_group_of(from.extras, place_);
        base(from.pbrMetallicRoughness, to);
        alpha(from, to);
        emission(from, to);
        for (const auto& [name, extension] : from.extensions) this->extension(name, extension, to);
        if (to.clearcoat > 0.0f && to.transmission > 0.0f)
            ignore("KHR_materials_clearcoat on glass");
        if (to.is_translucent() && to.transmission == 0.0f && !to.is_thin)
            ignore("KHR_materials_volume of diffuse transmission");
        textures(from, to);
        if (from.extensions.contains("KHR_materials_unlit")) shine(to);
        return to;
    }

    /// Set of coordinates that the textures of the last material use; -1: it has none.
    [[nodiscard]] int coordinates() const { return set_; }

 private:
    void ignore(const std::string& what) { ++report_.ignored[what]; }

    float unit(double value, const char* what) { return unit_factor(value, what, place_, report_); }

    void base(const tinygltf::PbrMetallicRoughness& from, Material& to) {
        const auto& color = from.baseColorFactor;
        to.base_color = {unit(color[0], "baseColorFactor"), unit(color[1], "baseColorFactor"),
                         unit(color[2], "baseColorFactor")};
        to.alpha = unit(color[3], "baseColorFactor");
        to.metallic = unit(from.metallicFactor, "metallicFactor");
        to.roughness = unit(from.roughnessFactor, "roughnessFactor");
    }

    void alpha(const tinygltf::Material& from, Material& to) {
        if (from.alphaMode == "MASK")
            to.alpha_cutoff = checked_amount(from.alphaCutoff, "alphaCutoff", place_);
        else if (from.alphaMode == "BLEND")
            to.is_blended = true;
        else if (from.alphaMode != "OPAQUE")
            ignore("alphaMode " + from.alphaMode);
    }

    void emission(const tinygltf::Material& from, Material& to) {
        double strength = 1.0;
        const auto found = from.extensions.find("KHR_materials_emissive_strength");
        if (found != from.extensions.end())
            strength = number_or(found->second, "emissiveStrength", 1.0, place_);
        // Each alone first: two negative ones would make a positive product.
        (void)checked_amount(strength, "emissiveStrength", place_);
        const auto channel = [&](std::size_t k) {
            (void)checked_amount(from.emissiveFactor[k], "emissiveFactor", place_);
            return checked_amount(from.emissiveFactor[k] * strength,
                                  "emissiveFactor x emissiveStrength", place_);
        };
        to.emission = {channel(0), channel(1), channel(2)};
    }

    void extension(const std::string& name, const tinygltf::Value& value, Material& to) {
        if (name == "KHR_materials_emissive_strength" || name == "KHR_materials_unlit") return;
        if (name == "KHR_materials_specular") return specular(value, to);
        if (name == "KHR_materials_ior") return ior(value, to);
        if (name == "KHR_materials_transmission") return transmission(value, to);
        if (name == "KHR_materials_volume") return volume(value, to);
        if (name == "KHR_materials_clearcoat") return clearcoat(value, to);
        if (name == "KHR_materials_diffuse_transmission") return diffuse_transmission(value, to);
        if (name == "KHR_materials_pbrSpecularGlossiness") return specular_glossiness(value, to);
        count_extension(name, report_);
    }

    void specular(const tinygltf::Value& from, Material& to) {
        to.specular = unit(number_or(from, "specularFactor", 1.0, place_), "specularFactor");
        for (const char* texture : {"specularTexture", "specularColorTexture"})
            if (from.Has(texture)) ignore(std::string("texture ") + texture);
        const tinygltf::Value& color = from.Get("specularColorFactor");
        for (std::size_t k = 0; k < color.ArrayLen(); ++k)
            if (color.Get(static_cast<int>(k)).GetNumberAsDouble() != 1.0)
                return ignore("KHR_materials_specular specularColorFactor");
    }

    void ior(const tinygltf::Value& from, Material& to) {
        to.ior = checked_amount(number_or(from, "ior", 1.5, place_), "ior", place_);
        if (to.ior >= 1.0f) return;
        if (to.ior != 0.0f)
            gltf_fail(place_, "its index of refraction is below 1 (" + number_text(to.ior) +
                                  "; no material is like that); repair the value");
        to.ior = 1.5f;
        ignore("KHR_materials_ior of 0 (taken as 1.5)");
    }

    void transmission(const tinygltf::Value& from, Material& to) {
        to.transmission =
            unit(number_or(from, "transmissionFactor", 0.0, place_), "transmissionFactor");
    }

    void clearcoat(const tinygltf::Value& from, Material& to) {
        to.clearcoat = unit(number_or(from, "clearcoatFactor", 0.0, place_), "clearcoatFactor");
        to.clearcoat_roughness = unit(number_or(from, "clearcoatRoughnessFactor", 0.0, place_),
                                      "clearcoatRoughnessFactor");
        if (from.Has("clearcoatNormalTexture")) ignore("texture clearcoatNormalTexture");
    }

    void diffuse_transmission(const tinygltf::Value& from, Material& to) {
        constexpr const char* factor = "diffuseTransmissionFactor";
        to.diffuse_transmission = unit(number_or(from, factor, 0.0, place_), factor);
        const tinygltf::Value& color = from.Get("diffuseTransmissionColorFactor");
        if (color.ArrayLen() < 3) return;
        const auto channel = [&](int k) {
            return unit(color.Get(k).GetNumberAsDouble(), "diffuseTransmissionColorFactor");
        };
        to.diffuse_transmission_color = {channel(0), channel(1), channel(2)};
    }

    /// How thick it is, rays find out; that it is thick, makes it a body.
    void volume(const tinygltf::Value& from, Material& to) {
        const double thickness = number_or(from, "thicknessFactor", 0.0, place_);
        to.is_thin = !(checked_amount(thickness, "thicknessFactor", place_) > 0.0f);
        if (from.Has("thicknessTexture")) ignore("texture thicknessTexture");
        if (from.Has("attenuationDistance")) attenuation_distance(from, to);
        const tinygltf::Value& color = from.Get("attenuationColor");
        if (color.ArrayLen() < 3) return;
        const auto channel = [&](int k) {
            return unit(color.Get(k).GetNumberAsDouble(), "attenuationColor");
        };
        to.attenuation_color = {channel(0), channel(1), channel(2)};
    }

    void attenuation_distance(const tinygltf::Value& from, Material& to) {
        to.attenuation_distance = checked_amount(
            number_or(from, "attenuationDistance", 0.0, place_), "attenuationDistance", place_);
        if (to.attenuation_distance > 0.0f) return;
        gltf_fail(place_,
                  "its attenuationDistance is 0 (no light would be left after no way at all); "
                  "repair the value, or leave it out for a body that absorbs nothing");
    }

    /// Diffuse colour and glossiness carry over. The coloured reflectance at normal incidence has
    /// no place in a metallic-roughness dielectric.
    void specular_glossiness(const tinygltf::Value& from, Material& to) {
        to.metallic = 0.0f;
        to.roughness =
            1.0f - unit(number_or(from, "glossinessFactor", 1.0, place_), "glossinessFactor");
        to.base_color = {1.0f, 1.0f, 1.0f};
        const tinygltf::Value& color = from.Get("diffuseFactor");
        if (color.ArrayLen() >= 3)
            to.base_color = {unit(color.Get(0).GetNumberAsDouble(), "diffuseFactor"),
                             unit(color.Get(1).GetNumberAsDouble(), "diffuseFactor"),
                             unit(color.Get(2).GetNumberAsDouble(), "diffuseFactor")};
        to.alpha =
            color.ArrayLen() < 4 ? 1.0f : unit(color.Get(3).GetNumberAsDouble(), "diffuseFactor");
        ignore("KHR_materials_pbrSpecularGlossiness specularFactor");
        for (const char* texture : {"diffuseTexture", "specularGlossinessTexture"})
            if (from.Has(texture)) ignore(std::string("texture ") + texture);
    }

    void textures(const tinygltf::Material& from, Material& to) {
        const auto& pbr = from.pbrMetallicRoughness;
        MaterialTextures& t = to.textures;
        t.base_color = texture("baseColorTexture", pbr.baseColorTexture);
        t.metallic_roughness = texture("metallicRoughnessTexture", pbr.metallicRoughnessTexture);
        t.normal = texture("normalTexture", from.normalTexture);
        t.emission = texture("emissiveTexture", from.emissiveTexture);
        t.normal_scale =
            checked_float(from.normalTexture.scale, "scale of a normalTexture", place_);
        if (from.occlusionTexture.index >= 0) ignore("texture occlusionTexture");
        for (const GltfExtensionTexture& which : gltf_extension_textures)
            t.*which.part = texture(which.key, texture_under(from.extensions, which));
    }

    template <class TextureInfo>
    Texture texture(const char* name, const TextureInfo& info) {
        if (info.index < 0) return {};
        int set = 0;
        const Texture to =
            textures_.convert(name, info.index, info.texCoord, info.extensions, place_, set);
        if (!to.is_set()) return {};
        if (set_ < 0) set_ = set;
        if (set == set_) return to;
        ignore(std::string("texture ") + name + " on a second set of coordinates");
        return {};
    }

    /// What is seen in its own colour whatever the light is shines with that colour. Masks and
    /// blended surfaces need the texture, which then colours black.
    static void shine(Material& to) {
        to.emission = to.base_color;
        to.textures.emission = to.textures.base_color;
        if (!to.is_masked() && !to.is_blended) to.textures.base_color = {};
        to.textures.metallic_roughness = {};
        to.base_color = {0.0f, 0.0f, 0.0f};
        to.metallic = 0.0f;
        to.specular = 0.0f;
        to.diffuse_transmission = 0.0f;
    }

    const tinygltf::Model& model_;
    SceneReport& report_;
    GltfTextures textures_;
    std::string place_;
    int set_ = -1;
};

/// What glTF 2.0 gives to primitives without a material (3.7.2.1): white, metallic, rough.
inline Material gltf_default_material() {
    Material material;
    material.name = "glTF default";
    material.base_color = {1.0f, 1.0f, 1.0f};
    material.metallic = 1.0f;
    return material;
}

}  // namespace mir::detail
