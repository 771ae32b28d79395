// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_arrays.hpp"
#include "io/detail/gltf_nodes.hpp"
#include "mir/core/limits.hpp"
#include "mir/scene/placements.hpp"

#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mir::detail {

/// Places the meshes of a file's nodes, several times where EXT_mesh_gpu_instancing says so.
class GltfInstances {
 public:
    /// `places` gets one for each instance that `scene` gets.
    GltfInstances(const tinygltf::Model& model, const Limits& limits, Scene& scene,
                  Placements& places)
        : model_(model), limits_(limits), scene_(scene), places_(places) {}

    /// `parts`: the scene meshes of the node, which stand at `to_world`.
    /// @throws Error(invalid_input), Error(limit_exceeded) before the instances are stored.
    void add(const PlacedNode& placed, const std::vector<std::uint32_t>& parts,
             const DMat4& to_world) {
        const tinygltf::Node& node = model_.nodes[placed.node];
        place_ = node_place(model_, placed.node);
        const auto copies = node.extensions.find("EXT_mesh_gpu_instancing");
        if (copies == node.extensions.end()) {
            reserve(parts, 1);
            return store(parts, to_world);
        }
        read_copies(copies->second);
        reserve(parts, copies_);
        for (std::size_t i = 0; i < copies_; ++i) store(parts, to_world * copy_transform(i));
    }

 private:
    /// Every stored mesh has a triangle, so this bounds the number of instances as well.
    void reserve(const std::vector<std::uint32_t>& parts, std::uint64_t copies) {
        for (std::uint32_t part : parts) {
            const Mesh& mesh = scene_.meshes[part];
            triangles_ += saturating_mul(mesh.triangles.size(), copies);
            vertices_ += saturating_mul(mesh.positions.size(), copies);
            check_limit(triangles_, limits_.triangles, "triangles");
            check_limit(vertices_, limits_.vertices, "vertices");
        }
    }

    void store(const std::vector<std::uint32_t>& parts, const DMat4& to_world) {
        for (std::uint32_t part : parts) {
            scene_.instances.push_back({part});
            places_.instances.push_back(checked_matrix(to_world, place_));
        }
    }

    template <class Vec>
    std::vector<Vec> read_attribute(const tinygltf::Value& attributes, const char* name) {
        if (!attributes.Has(name)) return {};
        std::vector<Vec> values = read_vectors<Vec>(model_, index_under(attributes, name), place_);
        if (copies_ != 0 && values.size() != copies_)
            gltf_fail(place_, "the attributes of its instances differ in length (" +
                                  std::to_string(copies_) + " and " +
                                  std::to_string(values.size()) + "); repair the accessors");
        copies_ = values.size();
        return values;
    }

    void read_copies(const tinygltf::Value& extension) {
        copies_ = 0;
        if (!extension.Has("attributes"))
            gltf_fail(place_, "EXT_mesh_gpu_instancing has no attributes; repair or remove it");
        const tinygltf::Value& attributes = extension.Get("attributes");
        translations_ = read_attribute<Vec3>(attributes, "TRANSLATION");
        rotations_ = read_attribute<Vec4>(attributes, "ROTATION");
        scales_ = read_attribute<Vec3>(attributes, "SCALE");
    }

    [[nodiscard]] DMat4 copy_transform(std::size_t i) const {
        const Vec3 t = translations_.empty() ? Vec3(0.0f) : translations_[i];
        const Vec4 r = rotations_.empty() ? Vec4(0, 0, 0, 1) : rotations_[i];
        const Vec3 s = scales_.empty() ? Vec3(1.0f) : scales_[i];
        return compose({t.x, t.y, t.z}, {r.x, r.y, r.z, r.w}, {s.x, s.y, s.z}, place_);
    }

    const tinygltf::Model& model_;
    const Limits& limits_;
    Scene& scene_;
    Placements& places_;
    std::uint64_t triangles_ = 0;
    std::uint64_t vertices_ = 0;
    std::size_t copies_ = 0;
    std::vector<Vec3> translations_;
    std::vector<Vec4> rotations_;
    std::vector<Vec3> scales_;
    std::string place_;
};

}  // namespace mir::detail
