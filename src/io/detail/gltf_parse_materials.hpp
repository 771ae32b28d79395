// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/data_uri.hpp"
#include "io/detail/gltf_extension_textures.hpp"
#include "io/detail/gltf_parse_nodes.hpp"

#include <tiny_gltf.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace mir::detail {

inline tinygltf::Value parse_texture_transform(const GltfValue& from) {
    tinygltf::Value::Object to;
    take_numbers(from, "offset", 0, to);
    take_numbers(from, "scale", 0, to);
    take_number(from, "rotation", to);
    int set = -1;
    take(from, "texCoord", set);
    if (set >= 0) to["texCoord"] = tinygltf::Value(set);
    return tinygltf::Value(std::move(to));
}

/// What every use of a texture has; `TextureInfo` is one of tinygltf's three.
template <class TextureInfo>
void parse_texture_info(const GltfDocument& document, const GltfValue& from, TextureInfo& to) {
    to.index = document.index(from.need("index", "a whole number"), "texture");
    take(from, "texCoord", to.texCoord);
    take_extensions(from, to.extensions, [](const std::string& name, const GltfValue& value) {
        return name == "KHR_texture_transform" ? parse_texture_transform(value) : tinygltf::Value();
    });
}

inline void parse_surface(const GltfDocument& document, const GltfValue& from,
                          tinygltf::PbrMetallicRoughness& to) {
    take(from, "baseColorFactor", 4, to.baseColorFactor);
    take(from, "metallicFactor", to.metallicFactor);
    take(from, "roughnessFactor", to.roughnessFactor);
    if (const auto texture = from.find("baseColorTexture"))
        parse_texture_info(document, *texture, to.baseColorTexture);
    if (const auto texture = from.find("metallicRoughnessTexture"))
        parse_texture_info(document, *texture, to.metallicRoughnessTexture);
}

/// The textures under an extension that are read.
inline void take_textures(const GltfDocument& document, const std::string& extension,
                          const GltfValue& from, tinygltf::Value::Object& to) {
    for (const GltfExtensionTexture& t : gltf_extension_textures) {
        if (extension != t.extension) continue;
        const auto texture = from.find(t.key);
        if (!texture) continue;
        tinygltf::TextureInfo info;
        parse_texture_info(document, *texture, info);
        to[t.key] = value_of_texture(info);
    }
}

inline tinygltf::Value parse_material_extension(const GltfDocument& document,
                                                const std::string& name, const GltfValue& from) {
    tinygltf::Value::Object to;
    take_textures(document, name, from, to);
    if (name == "KHR_materials_emissive_strength") {
        take_number(from, "emissiveStrength", to);
    } else if (name == "KHR_materials_ior") {
        take_number(from, "ior", to);
    } else if (name == "KHR_materials_transmission") {
        take_number(from, "transmissionFactor", to);
    } else if (name == "KHR_materials_clearcoat") {
        take_number(from, "clearcoatFactor", to);
        take_number(from, "clearcoatRoughnessFactor", to);
        take_presence(from, "clearcoatNormalTexture", to);
    } else if (name == "KHR_materials_diffuse_transmission") {
        take_number(from, "diffuseTransmissionFactor", to);
        take_numbers(from, "diffuseTransmissionColorFactor", 3, to);
    } else if (name == "KHR_materials_volume") {
        take_number(from, "thicknessFactor", to);
        take_presence(from, "thicknessTexture", to);
        take_number(from, "attenuationDistance", to);
        take_numbers(from, "attenuationColor", 3, to);
    } else if (name == "KHR_materials_specular") {
        take_number(from, "specularFactor", to);
        take_numbers(from, "specularColorFactor", 3, to);
        take_presence(from, "specularTexture", to);
        take_presence(from, "specularColorTexture", to);
    } else if (name == "KHR_materials_pbrSpecularGlossiness") {
        take_number(from, "glossinessFactor", to);
        take_numbers(from, "diffuseFactor", 4, to);
        take_presence(from, "diffuseTexture", to);
        take_presence(from, "specularGlossinessTexture", to);
    }
    return tinygltf::Value(std::move(to));
}

inline void parse_material(const GltfDocument& document, const GltfValue& from,
                           tinygltf::Material& to) {
    if (const auto surface = from.find("pbrMetallicRoughness"))
        parse_surface(document, *surface, to.pbrMetallicRoughness);
    take(from, "emissiveFactor", 3, to.emissiveFactor);
    take(from, "alphaMode", to.alphaMode);
    if (to.alphaMode == "MASK") take(from, "alphaCutoff", to.alphaCutoff);
    take(from, "doubleSided", to.doubleSided);
    if (const auto texture = from.find("normalTexture")) {
        parse_texture_info(document, *texture, to.normalTexture);
        take(*texture, "scale", to.normalTexture.scale);
    }
    if (const auto texture = from.find("emissiveTexture"))
        parse_texture_info(document, *texture, to.emissiveTexture);
    // Not read, so that nothing inside can be wrong.
    if (from.find("occlusionTexture")) to.occlusionTexture.index = 0;
    take_extensions(from, to.extensions, [&](const std::string& name, const GltfValue& value) {
        return parse_material_extension(document, name, value);
    });
    tinygltf::Value::Object extras;
    if (const auto given = extras_of(from)) take_number(*given, "light_group", extras);
    to.extras = tinygltf::Value(std::move(extras));
}

/// Names of the texture coordinates that a material's textures are looked up with.
inline std::vector<std::string> coordinate_sets(const tinygltf::Material& material) {
    std::vector<std::string> names;
    const auto add = [&](int index, int set, const tinygltf::ExtensionMap& extensions) {
        const auto moved = extensions.find("KHR_texture_transform");
        if (moved != extensions.end() && moved->second.Has("texCoord"))
            set = moved->second.Get("texCoord").GetNumberAsInt();
        if (index >= 0) names.push_back("TEXCOORD_" + std::to_string(set));
    };
    const auto& surface = material.pbrMetallicRoughness;
    for (const tinygltf::TextureInfo* info :
         {&surface.baseColorTexture, &surface.metallicRoughnessTexture, &material.emissiveTexture})
        add(info->index, info->texCoord, info->extensions);
    add(material.normalTexture.index, material.normalTexture.texCoord,
        material.normalTexture.extensions);
    for (const GltfExtensionTexture& t : gltf_extension_textures) {
        const tinygltf::TextureInfo info = texture_under(material.extensions, t);
        add(info.index, info.texCoord, info.extensions);
    }
    return names;
}

inline tinygltf::Texture parse_texture(const GltfDocument& document, const GltfValue& from) {
    tinygltf::Texture to;
    to.name = from.name();
    take_index(document, from, "sampler", "sampler", to.sampler);
    take_index(document, from, "source", "image", to.source);
    return to;
}

inline tinygltf::Sampler parse_sampler(const GltfValue& from) {
    tinygltf::Sampler to;
    to.name = from.name();
    take(from, "magFilter", to.magFilter);
    take(from, "wrapS", to.wrapS);
    take(from, "wrapT", to.wrapT);
    return to;
}

/// An image. What a data URI holds stands in its bytes then, and it has no URI.
inline tinygltf::Image parse_image(const GltfDocument& document, const GltfValue& from,
                                   std::size_t index) {
    tinygltf::Image to;
    to.name = from.name();
    take_index(document, from, "bufferView", "bufferView", to.bufferView);
    if (to.bufferView >= 0) return to;
    take(from, "uri", to.uri);
    if (!is_data_uri(to.uri)) return to;
    to.image = data_uri_bytes(to.uri, gltf_place("image", index, to.name));
    to.uri.clear();
    return to;
}

}  // namespace mir::detail
