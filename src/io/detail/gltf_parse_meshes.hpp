// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_parse_nodes.hpp"

#include <tiny_gltf.h>

#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mir::detail {

/// tinygltf's number of an accessor's type.
inline int parse_accessor_type(const GltfValue& from) {
    constexpr std::array<std::pair<std::string_view, int>, 7> types = {
        {{"SCALAR", TINYGLTF_TYPE_SCALAR},
         {"VEC2", TINYGLTF_TYPE_VEC2},
         {"VEC3", TINYGLTF_TYPE_VEC3},
         {"VEC4", TINYGLTF_TYPE_VEC4},
         {"MAT2", TINYGLTF_TYPE_MAT2},
         {"MAT3", TINYGLTF_TYPE_MAT3},
         {"MAT4", TINYGLTF_TYPE_MAT4}}};
    const std::string& given = from.text();
    for (const auto& [name, type] : types)
        if (given == name) return type;
    from.fail("is '" + given.substr(0, 40) +
              "' (glTF knows SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4); repair it");
}

inline void parse_sparse(const GltfDocument& document, const GltfValue& from,
                         tinygltf::Accessor& to) {
    auto& sparse = to.sparse;
    sparse.isSparse = true;
    constexpr const char* whole = "a whole number";
    sparse.count =
        static_cast<int>(from.need("count", whole).whole(std::numeric_limits<int>::max()));
    const GltfValue indices = from.need("indices", "an object");
    sparse.indices.bufferView = document.index(indices.need("bufferView", whole), "bufferView");
    sparse.indices.byteOffset = 0;
    sparse.indices.componentType = 0;
    take(indices, "byteOffset", sparse.indices.byteOffset);
    take(indices, "componentType", sparse.indices.componentType);
    const GltfValue values = from.need("values", "an object");
    sparse.values.bufferView = document.index(values.need("bufferView", whole), "bufferView");
    sparse.values.byteOffset = 0;
    take(values, "byteOffset", sparse.values.byteOffset);
}

inline tinygltf::Accessor parse_accessor(const GltfDocument& document, const GltfValue& from) {
    tinygltf::Accessor to;
    to.name = from.name();
    take_index(document, from, "bufferView", "bufferView", to.bufferView);
    take(from, "byteOffset", to.byteOffset);
    take(from, "normalized", to.normalized);
    to.componentType = static_cast<int>(
        from.need("componentType", "a whole number").whole(std::numeric_limits<int>::max()));
    to.type = parse_accessor_type(from.need("type", "text"));
    (void)from.need("count", "a whole number");
    take(from, "count", to.count);
    if (const auto sparse = from.find("sparse")) parse_sparse(document, *sparse, to);
    return to;
}

inline tinygltf::BufferView parse_buffer_view(const GltfDocument& document, const GltfValue& from) {
    tinygltf::BufferView to;
    to.name = from.name();
    to.buffer = document.index(from.need("buffer", "a whole number"), "buffer");
    (void)from.need("byteLength", "a whole number");
    take(from, "byteOffset", to.byteOffset);
    take(from, "byteLength", to.byteLength);
    take(from, "byteStride", to.byteStride);
    return to;
}

/// The accessors of the attributes that are asked for.
inline std::map<std::string, int> parse_attributes(const GltfDocument& document,
                                                   const GltfValue& from,
                                                   const std::vector<std::string>& names) {
    std::map<std::string, int> to;
    for (const std::string& name : names)
        if (const auto accessor = from.find(name.c_str()))
            to[name] = document.index(*accessor, "accessor");
    return to;
}

/// A primitive of triangles with positions, as far as every one is drawn. Of others what tells why
/// they are not.
inline void parse_primitive(const GltfDocument& document, const GltfValue& from,
                            tinygltf::Primitive& to) {
    to.mode = TINYGLTF_MODE_TRIANGLES;
    take(from, "mode", to.mode);
    if (to.mode < TINYGLTF_MODE_TRIANGLES) return;
    const auto attributes = from.find("attributes");
    if (!attributes || !attributes->find("POSITION")) return;
    to.attributes = parse_attributes(document, *attributes, {"POSITION", "NORMAL", "COLOR_0"});
    take_index(document, from, "indices", "accessor", to.indices);
    take_index(document, from, "material", "material", to.material);
    take_extension_names(from, to.extensions);
}

inline bool has_targets(const GltfValue& mesh) {
    const auto list = mesh.find("primitives");
    if (!list || !list->json().is_array()) return false;
    for (const Json& primitive : list->json())
        if (primitive.is_object() && primitive.contains("targets")) return true;
    return false;
}

/// Positions and normals of the morph targets. What else they move, which is not read, is named in
/// `extras`, an object for each target.
inline void parse_targets(const GltfDocument& document, const GltfValue& from,
                          tinygltf::Primitive& to) {
    const auto targets = from.find("targets");
    if (!targets) return;
    const std::size_t count = targets->size();
    tinygltf::Value::Array others;
    for (std::size_t i = 0; i < count; ++i) {
        const GltfValue target = targets->at(i);
        to.targets.push_back(parse_attributes(document, target, {"POSITION", "NORMAL"}));
        tinygltf::Value::Object other;
        for (const auto& [name, accessor] : target.json().items())
            if (name.starts_with("COLOR_") || name.starts_with("TEXCOORD_"))
                other[name] = tinygltf::Value(true);
        others.emplace_back(std::move(other));
    }
    to.extras = tinygltf::Value(std::move(others));
}

}  // namespace mir::detail
