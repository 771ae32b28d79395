// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_meshes.hpp"
#include "io/detail/gltf_poses.hpp"
#include "mir/io/loaded_scene.hpp"

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace mir::detail {

/// The scene meshes that nodes have and where these stand. Nodes share what is stored once; a node
/// with weights of morph targets of its own, or with a skin, gets meshes of its own shape.
class GltfNodeMeshes {
 public:
    /// Converts every mesh that a node has in its stored form, or that none has. All must outlive
    /// this.
    GltfNodeMeshes(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                   const std::vector<int>& coordinates, const Limits& limits, LoadedScene& loaded)
        : model_(model),
          report_(loaded.report),
          poses_(model, nodes),
          meshes_(model, coordinates, limits, loaded.scene, loaded.report) {
        parts_ = meshes_.convert_all(stored_meshes(nodes));
    }

    struct Placed {
        const std::vector<std::uint32_t>& parts;  ///< valid until the next call
        DMat4 to_world;
    };

    /// @pre the node has a mesh
    /// @throws Error(invalid_input), Error(limit_exceeded)
    [[nodiscard]] Placed at(const PlacedNode& placed) {
        const tinygltf::Node& node = model_.nodes[placed.node];
        const auto mesh = static_cast<std::size_t>(node.mesh);
        if (const auto shape = skinned(node)) {
            own_ = meshes_.convert_shaped(mesh, *shape);
            // Joints alone place it (3.7.3.3).
            DMat4 to_world(1.0);
            to_world[3] = {shape->origin, 1.0};
            return {own_, to_world};
        }
        if (node.skin != no_skin) ++report_.ignored["skin"];
        if (!is_morphed(node)) return {parts_[mesh], placed.to_world};
        const auto weights = poses_.weights_of(node);
        const auto [known, is_new] = morphed_.try_emplace({mesh, weights});
        if (is_new) known->second = meshes_.convert_shaped(mesh, {weights, {}, {}});
        return {known->second, placed.to_world};
    }

 private:
    /// Copies of one node have nothing but its transform that could tell them apart.
    [[nodiscard]] std::optional<GltfShape> skinned(const tinygltf::Node& node) const {
        if (node.extensions.contains("EXT_mesh_gpu_instancing")) return std::nullopt;
        return poses_.skinned(node);
    }

    /// The node has other weights than its mesh.
    [[nodiscard]] bool is_morphed(const tinygltf::Node& node) const {
        tinygltf::Node plain;
        plain.mesh = node.mesh;
        return poses_.weights_of(node) != poses_.weights_of(plain);
    }

    [[nodiscard]] std::vector<char> stored_meshes(const std::vector<PlacedNode>& nodes) const {
        std::vector<char> is_used(model_.meshes.size(), 0);
        std::vector<char> is_plain(model_.meshes.size(), 0);
        for (const PlacedNode& placed : nodes) {
            const tinygltf::Node& node = model_.nodes[placed.node];
            if (node.mesh < 0 || !placed.is_visible) continue;
            const auto mesh = static_cast<std::size_t>(node.mesh);
            is_used[mesh] = 1;
            if (!skinned(node) && !is_morphed(node)) is_plain[mesh] = 1;
        }
        for (std::size_t m = 0; m < is_plain.size(); ++m)
            if (is_used[m] == 0) is_plain[m] = 1;
        return is_plain;
    }

    const tinygltf::Model& model_;
    SceneReport& report_;
    GltfPoses poses_;
    GltfMeshes meshes_;
    std::vector<std::vector<std::uint32_t>> parts_;
    std::vector<std::uint32_t> own_;
    std::map<std::pair<std::size_t, std::vector<double>>, std::vector<std::uint32_t>> morphed_;
};

}  // namespace mir::detail
