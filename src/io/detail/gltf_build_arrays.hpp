// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/math.hpp"
#include "mir/scene/world_geometry.hpp"

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace mir::detail {

/// @throws Error(limit_exceeded) for more geometry than a .glb holds.
inline void check_glb_bytes(std::uint64_t bytes, const std::string& what) {
    if (bytes > 0xf000'0000u)
        throw Error(ErrorCode::limit_exceeded,
                    what + " has " + std::to_string(bytes) +
                        " bytes of geometry (a .glb holds less than 4 GiB); write it in parts");
}

/// What glTF calls the numbers of an array: constants of tinygltf.
struct GltfArrayType {
    int component;
    int type;
    int target;
};

/// Appends an array to the first buffer of `model`; returns its accessor, of `count` elements.
template <class Element>
int add_gltf_array(tinygltf::Model& model, const std::vector<Element>& elements, std::size_t count,
                   GltfArrayType type) {
    auto& bytes = model.buffers[0].data;
    tinygltf::BufferView& view = model.bufferViews.emplace_back();
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = elements.size() * sizeof(Element);
    view.target = type.target;
    bytes.resize(bytes.size() + view.byteLength);
    std::memcpy(bytes.data() + view.byteOffset, elements.data(), view.byteLength);
    tinygltf::Accessor& accessor = model.accessors.emplace_back();
    accessor.bufferView = static_cast<int>(model.bufferViews.size() - 1);
    accessor.componentType = type.component;
    accessor.count = count;
    accessor.type = type.type;
    return static_cast<int>(model.accessors.size() - 1);
}

/// Appends an attribute of one to three floats for each vertex; returns its accessor.
template <class Element>
int add_gltf_floats(tinygltf::Model& model, const std::vector<Element>& elements) {
    static_assert(std::is_trivially_copyable_v<Element> && sizeof(Element) % 4 == 0);
    constexpr std::size_t bytes_of_float = 4;
    constexpr std::size_t floats = sizeof(Element) / bytes_of_float;
    constexpr int types[] = {TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3};
    return add_gltf_array(
        model, elements, elements.size(),
        {TINYGLTF_COMPONENT_TYPE_FLOAT, types[floats - 1], TINYGLTF_TARGET_ARRAY_BUFFER});
}

/// Appends one or more positions, with the bounds that glTF wants for them.
inline int add_gltf_positions(tinygltf::Model& model, const std::vector<Vec3>& positions) {
    const int index = add_gltf_floats(model, positions);
    Bounds bounds;
    for (const Vec3 p : positions) bounds.add(p);
    tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
    accessor.minValues = {bounds.low.x, bounds.low.y, bounds.low.z};
    accessor.maxValues = {bounds.high.x, bounds.high.y, bounds.high.z};
    return index;
}

}  // namespace mir::detail
