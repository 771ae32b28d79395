// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_document.hpp"
#include "io/detail/gltf_extension_textures.hpp"

#include <cstddef>
#include <initializer_list>
#include <optional>

namespace mir::detail {

/// Checks a member that names something, where it is there and a number.
inline void check_reference(const GltfDocument& document, const GltfValue& from, const char* key,
                            const char* kind) {
    if (!from.json().is_object()) return;
    const auto value = from.find(key);
    if (value && value->json().is_number()) (void)document.index(*value, kind);
}

inline void check_primitive_references(const GltfDocument& document, const GltfValue& from) {
    check_reference(document, from, "indices", "accessor");
    check_reference(document, from, "material", "material");
    if (!from.json().is_object()) return;
    const auto attributes = from.find("attributes");
    if (!attributes || !attributes->json().is_object()) return;
    for (const auto& member : attributes->json().items())
        check_reference(document, *attributes, member.key().c_str(), "accessor");
}

inline void check_material_references(const GltfDocument& document, const GltfValue& from) {
    const auto check = [&](const GltfValue& part, std::initializer_list<const char*> textures) {
        for (const char* key : textures)
            if (const auto texture = part.find(key))
                check_reference(document, *texture, "index", "texture");
    };
    if (!from.json().is_object()) return;
    check(from, {"normalTexture", "emissiveTexture", "occlusionTexture"});
    const auto surface = from.find("pbrMetallicRoughness");
    if (surface && surface->json().is_object())
        check(*surface, {"baseColorTexture", "metallicRoughnessTexture"});
    const auto extensions = from.find("extensions");
    if (!extensions || !extensions->json().is_object()) return;
    for (const GltfExtensionTexture& t : gltf_extension_textures)
        if (const auto extension = extensions->find(t.extension);
            extension && extension->json().is_object())
            check(*extension, {t.key});
}

/// Refuses numbers that name nothing, even where a picture does not need them. Most often such a
/// file was cut or put together wrongly.
/// @throws Error(invalid_input)
inline void check_references(const GltfDocument& document) {
    const auto for_each = [&](const char* kind, const auto& check) {
        for (std::size_t i = 0; i < document.count(kind); ++i) check(document.element(kind, i));
    };
    for_each("accessor", [&](const GltfValue& from) {
        check_reference(document, from, "bufferView", "bufferView");
    });
    for_each("bufferView",
             [&](const GltfValue& from) { check_reference(document, from, "buffer", "buffer"); });
    for_each("image", [&](const GltfValue& from) {
        check_reference(document, from, "bufferView", "bufferView");
    });
    for_each("material", [&](const GltfValue& from) { check_material_references(document, from); });
    for_each("mesh", [&](const GltfValue& from) {
        if (!from.json().is_object()) return;
        const auto list = from.find("primitives");
        if (!list || !list->json().is_array()) return;
        for (std::size_t k = 0; k < list->size(); ++k)
            check_primitive_references(document, list->at(k).as("primitive", k));
    });
}

}  // namespace mir::detail
