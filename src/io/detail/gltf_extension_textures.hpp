// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/texture.hpp"

#include <tiny_gltf.h>

#include <array>
#include <string>
#include <utility>

namespace mir::detail {

/// A texture under an extension of a material. tinygltf knows none of them.
struct GltfExtensionTexture {
    const char* extension;            ///< of the material
    const char* key;                  ///< of the texture there
    Texture MaterialTextures::*part;  ///< what it becomes
};

/// Those that are read.
inline constexpr std::array gltf_extension_textures = {
    GltfExtensionTexture{"KHR_materials_transmission", "transmissionTexture",
                         &MaterialTextures::transmission},
    GltfExtensionTexture{"KHR_materials_clearcoat", "clearcoatTexture",
                         &MaterialTextures::clearcoat},
    GltfExtensionTexture{"KHR_materials_clearcoat", "clearcoatRoughnessTexture",
                         &MaterialTextures::clearcoat_roughness},
    GltfExtensionTexture{"KHR_materials_diffuse_transmission", "diffuseTransmissionTexture",
                         &MaterialTextures::diffuse_transmission},
    GltfExtensionTexture{"KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture",
                         &MaterialTextures::diffuse_transmission_color},
};

/// The use of a texture as a value of an extension.
inline tinygltf::Value value_of_texture(const tinygltf::TextureInfo& from) {
    tinygltf::Value::Object to{{"index", tinygltf::Value(from.index)}};
    if (from.texCoord != 0) to["texCoord"] = tinygltf::Value(from.texCoord);
    tinygltf::Value::Object extensions(from.extensions.begin(), from.extensions.end());
    if (!extensions.empty()) to["extensions"] = tinygltf::Value(std::move(extensions));
    return tinygltf::Value(std::move(to));
}

/// The use of a texture under an extension of a material; index -1 where it has none.
inline tinygltf::TextureInfo texture_under(const tinygltf::ExtensionMap& extensions,
                                           const GltfExtensionTexture& which) {
    tinygltf::TextureInfo to;
    const auto extension = extensions.find(which.extension);
    if (extension == extensions.end() || !extension->second.Has(which.key)) return to;
    const tinygltf::Value& from = extension->second.Get(which.key);
    to.index = from.Get("index").GetNumberAsInt();
    if (from.Has("texCoord")) to.texCoord = from.Get("texCoord").GetNumberAsInt();
    if (from.Has("extensions"))
        for (const auto& [name, value] : from.Get("extensions").Get<tinygltf::Value::Object>())
            to.extensions[name] = value;
    return to;
}

/// Takes the textures away that are under extensions of a material.
inline void drop_extension_textures(tinygltf::ExtensionMap& extensions) {
    for (const GltfExtensionTexture& t : gltf_extension_textures) {
        const auto found = extensions.find(t.extension);
        if (found != extensions.end() && found->second.IsObject())
            found->second.Get<tinygltf::Value::Object>().erase(t.key);
    }
}

}  // namespace mir::detail
