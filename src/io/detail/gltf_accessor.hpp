// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_check.hpp"
#include "mir/core/limits.hpp"

#include <tiny_gltf.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace mir::detail {

/// Bytes that hold `count` elements, each `stride` bytes after the one before.
struct GltfElements {
    const unsigned char* first = nullptr;  ///< nullptr: every element is zero
    std::size_t stride = 0;
    std::size_t count = 0;
    int component_type = 0;
};

/// Bytes of one component; 0 for a type that glTF 2.0 does not have.
inline std::size_t gltf_component_size(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

inline void check_buffer_view(const tinygltf::Model& model, std::size_t index) {
    const tinygltf::BufferView& view = model.bufferViews[index];
    const std::string place = gltf_place("bufferView", index, view.name);
    const auto& bytes =
        model.buffers[checked_index(view.buffer, model.buffers.size(), "buffer", place)].data;
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
        gltf_fail(place, "its " + std::to_string(view.byteLength) + " bytes from byte " +
                             std::to_string(view.byteOffset) + " reach past its buffer of " +
                             std::to_string(bytes.size()) + " bytes; repair or re-export the file");
}

/// `count` elements of `size` bytes from byte `offset` of a view.
/// @throws Error(invalid_input) when they do not lie inside the view.
inline GltfElements elements_in_view(const tinygltf::Model& model, int view_index,
                                     std::uint64_t offset, std::uint64_t count, std::uint64_t size,
                                     int component_type, const std::string& place) {
    const std::size_t at = checked_index(view_index, model.bufferViews.size(), "bufferView", place);
    check_buffer_view(model, at);
    const tinygltf::BufferView& view = model.bufferViews[at];
    const std::uint64_t stride = view.byteStride == 0 ? size : view.byteStride;
    if (stride < size)
        gltf_fail(place, "its elements of " + std::to_string(size) + " bytes overlap (byteStride " +
                             std::to_string(stride) + "); repair the bufferView");
    const std::uint64_t before_last = saturating_mul(count - 1, stride);
    const std::uint64_t length = view.byteLength;
    if (size > length || offset > length - size || before_last > length - size - offset)
        gltf_fail(place, "its " + std::to_string(count) + " elements reach past bufferView " +
                             std::to_string(view_index) + " of " + std::to_string(length) +
                             " bytes; repair or re-export the file");
    const auto& bytes = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    return {bytes.data() + view.byteOffset + offset, stride, count, component_type};
}

/// @throws Error(invalid_input) when they do not lie inside of their buffer.
inline GltfElements accessor_elements(const tinygltf::Model& model, std::size_t index) {
    const tinygltf::Accessor& accessor = model.accessors[index];
    const std::string place = gltf_place("accessor", index, accessor.name);
    const std::size_t component = gltf_component_size(accessor.componentType);
    const int components =
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (component == 0 || components <= 0)
        gltf_fail(place, "component type " + std::to_string(accessor.componentType) +
                             " is not one of glTF 2.0; export the file again");
    if (accessor.count == 0)
        gltf_fail(place, "it has no elements (glTF asks for one at least); export the file again");
    if (accessor.bufferView >= 0)
        return elements_in_view(model, accessor.bufferView, accessor.byteOffset, accessor.count,
                                component * static_cast<std::size_t>(components),
                                accessor.componentType, place);
    // Zeros cost no byte of the file, so the file's size has to bound them.
    std::uint64_t bytes = 0;
    for (const tinygltf::Buffer& buffer : model.buffers) bytes += buffer.data.size();
    if (accessor.count > bytes)
        gltf_fail(place, "it declares " + std::to_string(accessor.count) +
                             " elements without data (the file has " + std::to_string(bytes) +
                             " bytes of data); give it a bufferView");
    return {nullptr, 0, accessor.count, accessor.componentType};
}

template <class T>
T load_as(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// One component as a number. Normalised integers are mapped to -1..1 or 0..1 as the specification
/// says (3.6.2.2).
inline float load_component(const unsigned char* bytes, int type, bool normalized) {
    const auto mapped = [normalized](float value, float most) {
        return normalized ? larger(value / most, -1.0f) : value;
    };
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return mapped(load_as<std::int8_t>(bytes), 127.0f);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return mapped(*bytes, 255.0f);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return mapped(load_as<std::int16_t>(bytes), 32767.0f);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return mapped(load_as<std::uint16_t>(bytes), 65535.0f);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return static_cast<float>(load_as<std::uint32_t>(bytes));
        default:
            return load_as<float>(bytes);
    }
}

inline std::uint32_t load_index(const unsigned char* bytes, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return *bytes;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load_as<std::uint16_t>(bytes);
        default:
            return load_as<std::uint32_t>(bytes);
    }
}

inline bool is_index_type(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

}  // namespace mir::detail
