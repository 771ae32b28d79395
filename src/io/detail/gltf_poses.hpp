// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_arrays.hpp"
#include "io/detail/gltf_deform.hpp"
#include "io/detail/gltf_nodes.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace mir::detail {

/// Tells how the meshes of nodes are shaped at rest. That is how the scene stands.
class GltfPoses {
 public:
    /// Both must outlive this.
    GltfPoses(const tinygltf::Model& model, const std::vector<PlacedNode>& placed) : model_(model) {
        for (const PlacedNode& p : placed) to_world_.emplace(p.node, &p.to_world);
    }

    /// Weights of morph targets: the node's, else the mesh's, else none.
    [[nodiscard]] std::vector<double> weights_of(const tinygltf::Node& node) const {
        const auto& mesh = model_.meshes[static_cast<std::size_t>(node.mesh)];
        std::vector<double> weights = node.weights.empty() ? mesh.weights : node.weights;
        while (!weights.empty() && weights.back() == 0.0) weights.pop_back();
        return weights;
    }

    /// The shape of a node's mesh that its skin gives. None when it has none that can be used.
    [[nodiscard]] std::optional<GltfShape> skinned(const tinygltf::Node& node) const {
        if (node.skin < 0 || !has_joints(node)) return std::nullopt;
        const tinygltf::Skin& skin = model_.skins[static_cast<std::size_t>(node.skin)];
        GltfShape shape{weights_of(node), {}, {}};
        for (const int joint : skin.joints) {
            const auto at = to_world_.find(static_cast<std::size_t>(joint));
            if (at == to_world_.end()) return std::nullopt;
            shape.joints.push_back(*at->second);
        }
        if (shape.joints.empty()) return std::nullopt;
        shape.origin = DVec3(shape.joints.front()[3]);
        if (skin.inverseBindMatrices < 0) return shape;
        const auto bind = bind_matrices(skin.inverseBindMatrices, shape.joints.size());
        for (std::size_t i = 0; i < bind.size(); ++i) shape.joints[i] = shape.joints[i] * bind[i];
        return shape;
    }

 private:
    /// Every primitive that is drawn hangs on joints.
    [[nodiscard]] bool has_joints(const tinygltf::Node& node) const {
        const auto& primitives = model_.meshes[static_cast<std::size_t>(node.mesh)].primitives;
        return std::all_of(primitives.begin(), primitives.end(), [](const auto& primitive) {
            return !primitive.attributes.contains("POSITION") ||
                   (primitive.attributes.contains("JOINTS_0") &&
                    primitive.attributes.contains("WEIGHTS_0"));
        });
    }

    [[nodiscard]] std::vector<DMat4> bind_matrices(int index, std::size_t joints) const {
        const auto at = static_cast<std::size_t>(index);
        const tinygltf::Accessor& accessor = model_.accessors[at];
        const std::string place = gltf_place("accessor", at, accessor.name);
        const GltfElements elements = accessor_elements(model_, at);
        if (accessor.type != TINYGLTF_TYPE_MAT4 ||
            accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.sparse.isSparse ||
            elements.first == nullptr || elements.count < joints)
            gltf_fail(place, "it does not hold a matrix for each of the " + std::to_string(joints) +
                                 " joints of a skin (of floats, not sparse); export it again");
        std::vector<DMat4> matrices(joints);
        for (std::size_t i = 0; i < joints; ++i)
            for (int k = 0; k < 16; ++k)
                matrices[i][k / 4][k % 4] =
                    load_as<float>(elements.first + i * elements.stride +
                                   static_cast<std::size_t>(k) * sizeof(float));
        return matrices;
    }

    const tinygltf::Model& model_;
    std::unordered_map<std::size_t, const DMat4*> to_world_;
};

}  // namespace mir::detail
