// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_accessor.hpp"
#include "io/detail/gltf_triangles.hpp"
#include "mir/core/math.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace mir::detail {

template <class Vec>
Vec load_vector(const unsigned char* bytes, int type, bool normalized) {
    Vec value;
    const std::size_t step = gltf_component_size(type);
    for (int k = 0; k < Vec::length(); ++k)
        value[k] = load_component(bytes + static_cast<std::size_t>(k) * step, type, normalized);
    return value;
}

/// Overwrites the elements that a sparse accessor lists. Each has `components` numbers, which
/// `element` makes of their bytes.
template <class T, class Element>
void apply_sparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                  const std::string& place, std::size_t components, const Element& element,
                  std::vector<T>& values) {
    const auto& sparse = accessor.sparse;
    const auto& where = sparse.indices;
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count ||
        where.byteOffset < 0 || sparse.values.byteOffset < 0 || !is_index_type(where.componentType))
        gltf_fail(place, "its sparse part is broken (count, offset or index type); repair it");
    const auto count = static_cast<std::uint64_t>(sparse.count);
    const GltfElements indices = elements_in_view(
        model, where.bufferView, static_cast<std::uint64_t>(where.byteOffset), count,
        gltf_component_size(where.componentType), where.componentType, place);
    const GltfElements replaced = elements_in_view(
        model, sparse.values.bufferView, static_cast<std::uint64_t>(sparse.values.byteOffset),
        count, gltf_component_size(accessor.componentType) * components, accessor.componentType,
        place);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t at =
            load_index(indices.first + i * indices.stride, indices.component_type);
        if (at >= values.size())
            gltf_fail(place, "its sparse part replaces element " + std::to_string(at) + " of " +
                                 std::to_string(values.size()) + "; repair the index");
        values[at] = element(replaced.first + i * replaced.stride);
    }
}

/// Vectors of an accessor of any component type, sparse parts applied. `Vec` is Vec2, Vec3 or Vec4.
/// @throws Error(invalid_input) when the accessor holds something else.
template <class Vec>
std::vector<Vec> read_vectors(const tinygltf::Model& model, int index, const std::string& user) {
    const std::size_t at = checked_index(index, model.accessors.size(), "accessor", user);
    const tinygltf::Accessor& accessor = model.accessors[at];
    const std::string place = gltf_place("accessor", at, accessor.name);
    if (accessor.type != Vec::length())
        gltf_fail(place, "it does not hold vectors of " + std::to_string(Vec::length()) +
                             " components, which " + user + " needs; repair its type");
    const GltfElements elements = accessor_elements(model, at);
    std::vector<Vec> values(elements.count, Vec(0.0f));
    const auto element = [&](const unsigned char* bytes) {
        return load_vector<Vec>(bytes, accessor.componentType, accessor.normalized);
    };
    if (elements.first != nullptr)
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = element(elements.first + i * elements.stride);
    if (accessor.sparse.isSparse)
        apply_sparse(model, accessor, place, Vec::length(), element, values);
    return values;
}

/// The chosen vertices of an accessor. It has one element for every vertex of its primitive. `what`
/// names them, `user` whoever has them.
/// @throws Error(invalid_input) when there are more or fewer.
template <class Vec>
std::vector<Vec> read_vertices(const tinygltf::Model& model, int index, const VertexChoice& choice,
                               const std::string& what, const std::string& user) {
    const std::size_t at = checked_index(index, model.accessors.size(), "accessor", user);
    const tinygltf::Accessor& accessor = model.accessors[at];
    if (accessor.count != choice.all)
        gltf_fail(user, "it has " + std::to_string(accessor.count) + " " + what + " for " +
                            std::to_string(choice.all) + " positions; give one each or none");
    const bool is_plain = !accessor.sparse.isSparse && accessor.type == Vec::length();
    if (choice.chosen.empty() || !is_plain) {
        std::vector<Vec> all = read_vectors<Vec>(model, index, user);
        if (choice.chosen.empty()) return all;
        for (std::size_t i = 0; i < choice.chosen.size(); ++i) all[i] = all[choice.chosen[i]];
        all.resize(choice.chosen.size());
        all.shrink_to_fit();
        return all;
    }
    const GltfElements elements = accessor_elements(model, at);
    std::vector<Vec> values(choice.chosen.size(), Vec(0.0f));
    if (elements.first == nullptr) return values;
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = load_vector<Vec>(elements.first + choice.chosen[i] * elements.stride,
                                     elements.component_type, accessor.normalized);
    return values;
}

/// Vertex indices of 8, 16 or 32 bits, sparse parts applied.
/// @throws Error(invalid_input) when the accessor holds something else.
inline std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int index,
                                               const std::string& user) {
    const std::size_t at = checked_index(index, model.accessors.size(), "accessor", user);
    const tinygltf::Accessor& accessor = model.accessors[at];
    const std::string place = gltf_place("accessor", at, accessor.name);
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_index_type(accessor.componentType))
        gltf_fail(place, "it does not hold unsigned numbers, which the indices of " + user +
                             " have to be; repair its type");
    const GltfElements elements = accessor_elements(model, at);
    const auto element = [&](const unsigned char* bytes) {
        return load_index(bytes, accessor.componentType);
    };
    std::vector<std::uint32_t> values(elements.count);
    if (elements.first != nullptr)
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = element(elements.first + i * elements.stride);
    if (accessor.sparse.isSparse) apply_sparse(model, accessor, place, 1, element, values);
    return values;
}

}  // namespace mir::detail
