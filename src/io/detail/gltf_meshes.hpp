// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_arrays.hpp"
#include "io/detail/gltf_deform.hpp"
#include "io/detail/gltf_materials.hpp"
#include "io/detail/gltf_tints.hpp"
#include "io/detail/unit_direction.hpp"
#include "mir/core/limits.hpp"
#include "mir/scene/scene.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mir::detail {

/// Turns the primitives of a file into meshes of a scene. Its materials are already there.
class GltfMeshes {
 public:
    /// `coordinates`: the set of texture coordinates of each material, -1 for none. Materials are
    /// those of the file.
    GltfMeshes(const tinygltf::Model& model, const std::vector<int>& coordinates,
               const Limits& limits, Scene& scene, SceneReport& report)
        : model_(model),
          coordinates_(coordinates),
          limits_(limits),
          scene_(scene),
          report_(report) {}

    /// For every mesh of the file, the scene meshes of its primitives. None for those that no node
    /// has as they are stored, which `is_plain` tells.
    /// @throws Error(invalid_input), Error(limit_exceeded)
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> convert_all(
        const std::vector<char>& is_plain) {
        std::vector<std::vector<std::uint32_t>> parts(model_.meshes.size());
        for (std::size_t m = 0; m < parts.size(); ++m)
            if (is_plain[m] != 0) reserve(m);
        for (std::size_t m = 0; m < parts.size(); ++m)
            if (is_plain[m] != 0)
                parts[m] = convert(m, GltfShape{model_.meshes[m].weights, {}, {}});
        return parts;
    }

    /// The scene meshes of one mesh in a shape of its own.
    /// @throws Error(invalid_input), Error(limit_exceeded)
    [[nodiscard]] std::vector<std::uint32_t> convert_shaped(std::size_t m, const GltfShape& shape) {
        reserve(m);
        return convert(m, shape);
    }

 private:
    std::vector<std::uint32_t> convert(std::size_t m, const GltfShape& shape) {
        std::vector<std::uint32_t> parts;
        // None where the mesh is broken and no node has it.
        const std::size_t primitives = model_.meshes[m].primitives.size();
        for (std::size_t k = 0; k < primitives; ++k) convert(m, k, shape, parts);
        return parts;
    }

    void convert(std::size_t m, std::size_t k, const GltfShape& shape,
                 std::vector<std::uint32_t>& parts) {
        const tinygltf::Primitive& from = model_.meshes[m].primitives[k];
        place_ = gltf_place("mesh", m, model_.meshes[m].name) + ", primitive " + std::to_string(k);
        if (!has_triangles(from)) return;
        Mesh mesh;
        mesh.name = name_of(m, k);
        mesh.material = material_of(from);
        read_triangles(from, mesh);
        if (mesh.triangles.empty()) return ignore("primitive without triangles");
        read_positions(from, shape, mesh);
        read_coordinates(from, mesh);
        read_colors(from, mesh);
        count_targets(from, shape.weights);
        check_mesh(scene_, mesh);
        for (const auto& [name, value] : from.extensions) count_extension(name, report_);
        parts.push_back(static_cast<std::uint32_t>(scene_.meshes.size()));
        scene_.meshes.push_back(std::move(mesh));
    }

    /// Bounds the memory of a mesh before any of it is taken. A small file can ask for much, by
    /// primitives that share accessors.
    void reserve(std::size_t m) {
        const tinygltf::Mesh& mesh = model_.meshes[m];
        for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
            const tinygltf::Primitive& from = mesh.primitives[k];
            place_ = gltf_place("mesh", m, mesh.name) + ", primitive " + std::to_string(k);
            const auto positions = from.attributes.find("POSITION");
            if (positions == from.attributes.end()) continue;
            const std::uint64_t vertices = count_of(positions->second);
            const std::uint64_t order = from.indices >= 0 ? count_of(from.indices) : vertices;
            const std::uint64_t each =
                sizeof(Vec3) + from.attributes.contains("NORMAL") * sizeof(Vec3) +
                from.attributes.contains("COLOR_0") * sizeof(Rgb) + sizeof(Vec2);
            const bool list = from.mode == TINYGLTF_MODE_TRIANGLES;
            bytes_ += saturating_mul(std::min(vertices, order), each) +
                      saturating_mul(list ? order / 3 : order, sizeof(TriangleIndices));
            check_limit(bytes_, limits_.mesh_bytes, "mesh_bytes");
        }
    }

    void ignore(const std::string& what) { ++report_.ignored[what]; }

    [[nodiscard]] std::string name_of(std::size_t m, std::size_t k) const {
        const tinygltf::Mesh& mesh = model_.meshes[m];
        const std::string name = mesh.name.empty() ? "mesh " + std::to_string(m) : mesh.name;
        return mesh.primitives.size() == 1 ? name : name + "/" + std::to_string(k);
    }

    bool has_triangles(const tinygltf::Primitive& from) {
        if (from.mode < TINYGLTF_MODE_POINTS || from.mode > TINYGLTF_MODE_TRIANGLE_FAN)
            gltf_fail(place_, "mode " + std::to_string(from.mode) +
                                  " is none of glTF 2.0 (0 to 6); repair it");
        if (from.mode < TINYGLTF_MODE_TRIANGLES) {
            ignore(from.mode == TINYGLTF_MODE_POINTS ? "primitive of points"
                                                     : "primitive of lines");
            return false;
        }
        if (from.attributes.find("POSITION") != from.attributes.end()) return true;
        ignore("primitive without positions");
        return false;
    }

    std::uint32_t material_of(const tinygltf::Primitive& from) {
        if (from.material >= 0)
            return static_cast<std::uint32_t>(
                checked_index(from.material, model_.materials.size(), "material", place_));
        if (!default_material_) default_material_ = scene_.add(gltf_default_material());
        return *default_material_;
    }

    /// Number of elements of an accessor that nothing has been read from yet.
    [[nodiscard]] std::uint64_t count_of(int accessor) const {
        return accessor_elements(
                   model_, checked_index(accessor, model_.accessors.size(), "accessor", place_))
            .count;
    }

    void read_triangles(const tinygltf::Primitive& from, Mesh& mesh) {
        const int positions = from.attributes.at("POSITION");
        const std::uint64_t count = count_of(from.indices >= 0 ? from.indices : positions);
        const bool list = from.mode == TINYGLTF_MODE_TRIANGLES;
        triangles_ += list ? count / 3 : count;
        check_limit(triangles_, limits_.triangles, "triangles");
        if (list && count % 3 != 0) ignore("incomplete triangle at the end of a primitive");
        std::vector<std::uint32_t> order;
        if (from.indices >= 0) {
            order = read_indices(model_, from.indices, place_);
        } else {
            order.resize(count);
            for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
        }
        mesh.triangles = gltf_triangles(order, from.mode);
    }

    void read_positions(const tinygltf::Primitive& from, const GltfShape& shape, Mesh& mesh) {
        const int positions = from.attributes.at("POSITION");
        choice_ = choose_vertices(mesh.triangles, count_of(positions));
        vertices_ += choice_.size();
        check_limit(vertices_, limits_.vertices, "vertices");
        mesh.positions = read_vertices<Vec3>(model_, positions, choice_, "positions", place_);
        const auto normals = from.attributes.find("NORMAL");
        if (normals != from.attributes.end())
            mesh.normals = read_vertices<Vec3>(model_, normals->second, choice_, "normals", place_);
        morph(model_, from, shape.weights, choice_, place_, mesh);
        if (!shape.joints.empty())
            bend(JointBlend(model_, from, shape.joints, choice_, place_), shape.origin, mesh);
        bool all_directions = true;
        for (Vec3& n : mesh.normals) {
            n = unit_direction(n);
            all_directions = all_directions && n != Vec3(0.0f);
        }
        // Exporters write such normals at triangles without area; shading falls back to flat.
        if (!all_directions) ignore("normal without a direction (mesh counted once)");
    }

    void read_coordinates(const tinygltf::Primitive& from, Mesh& mesh) {
        const int set = from.material < 0 ? -1 : coordinates_[mesh.material];
        if (set < 0) return;
        const auto found = from.attributes.find("TEXCOORD_" + std::to_string(set));
        if (found == from.attributes.end())
            return ignore("textured mesh without texture coordinates");
        mesh.texture_coordinates =
            read_vertices<Vec2>(model_, found->second, choice_, "texture coordinates", place_);
    }

    /// Linear. Alpha cuts out where the material is a mask, and does nothing else.
    void read_colors(const tinygltf::Primitive& from, Mesh& mesh) {
        const auto found = from.attributes.find("COLOR_0");
        if (found == from.attributes.end()) return;
        const auto at = checked_index(found->second, model_.accessors.size(), "accessor", place_);
        std::vector<float> alpha;
        const auto add = [&](const auto& colors) {
            for (const auto& c : colors)
                mesh.colors.push_back({unit_factor(c.x, "COLOR_0", place_, report_),
                                       unit_factor(c.y, "COLOR_0", place_, report_),
                                       unit_factor(c.z, "COLOR_0", place_, report_)});
        };
        if (model_.accessors[at].type == TINYGLTF_TYPE_VEC4) {
            const auto colors =
                read_vertices<Vec4>(model_, found->second, choice_, "colors", place_);
            add(colors);
            for (const Vec4& c : colors)
                alpha.push_back(unit_factor(c.w, "COLOR_0", place_, report_));
        } else {
            add(read_vertices<Vec3>(model_, found->second, choice_, "colors", place_));
        }
        if (from.material >= 0) tints_.apply(is_unlit(from), alpha, scene_, report_, mesh);
    }

    /// Counts the morph targets that would move what positions and normals are not.
    void count_targets(const tinygltf::Primitive& from, const std::vector<double>& weights) {
        const int set =
            from.material < 0 ? -1 : coordinates_[static_cast<std::size_t>(from.material)];
        const std::string coordinates = "TEXCOORD_" + std::to_string(set);
        for (std::size_t i = 0; i < weights.size() && i < from.targets.size(); ++i) {
            if (weights[i] == 0.0) continue;
            const tinygltf::Value& moves = from.extras.Get(static_cast<int>(i));
            for (const std::string& name : {std::string("COLOR_0"), coordinates})
                if (moves.Has(name) && from.attributes.contains(name))
                    ignore("morph target of " + name);
        }
    }

    [[nodiscard]] bool is_unlit(const tinygltf::Primitive& from) const {
        return model_.materials[static_cast<std::size_t>(from.material)].extensions.contains(
            "KHR_materials_unlit");
    }

    const tinygltf::Model& model_;
    const std::vector<int>& coordinates_;
    const Limits& limits_;
    Scene& scene_;
    SceneReport& report_;
    std::optional<std::uint32_t> default_material_;
    std::uint64_t triangles_ = 0;
    std::uint64_t vertices_ = 0;
    std::uint64_t bytes_ = 0;
    VertexChoice choice_;  ///< of the primitive that is read
    GltfTints tints_;
    std::string place_;
};

}  // namespace mir::detail
