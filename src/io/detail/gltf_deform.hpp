// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_arrays.hpp"
#include "mir/core/math.hpp"
#include "mir/scene/mesh.hpp"

#include <tiny_gltf.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace mir::detail {

/// How a node's mesh differs from the one that is stored.
struct GltfShape {
    std::vector<double> weights;  ///< of morph targets
    std::vector<DMat4> joints;    ///< from the mesh to the scene; none: it has no skin
    DVec3 origin{0.0};            ///< what vertices of a skinned mesh are counted from
};

/// Adds the displacements of morph targets to positions and normals.
/// @throws Error(invalid_input)
inline void morph(const tinygltf::Model& model, const tinygltf::Primitive& from,
                  const std::vector<double>& weights, const VertexChoice& choice,
                  const std::string& place, Mesh& mesh) {
    const auto add = [&](int accessor, double weight, std::vector<Vec3>& to) {
        const auto moves = read_vertices<Vec3>(model, accessor, choice, "morph targets", place);
        for (std::size_t i = 0; i < to.size(); ++i) to[i] += static_cast<float>(weight) * moves[i];
    };
    for (std::size_t i = 0; i < from.targets.size() && i < weights.size(); ++i) {
        if (weights[i] == 0.0) continue;
        const auto positions = from.targets[i].find("POSITION");
        const auto normals = from.targets[i].find("NORMAL");
        if (positions != from.targets[i].end()) add(positions->second, weights[i], mesh.positions);
        if (normals != from.targets[i].end() && !mesh.normals.empty())
            add(normals->second, weights[i], mesh.normals);
    }
}

/// Sums the transforms of the joints that a vertex hangs on.
class JointBlend {
 public:
    /// @throws Error(invalid_input) when a vertex names a joint that the skin has not.
    JointBlend(const tinygltf::Model& model, const tinygltf::Primitive& from,
               const std::vector<DMat4>& joints, const VertexChoice& choice,
               const std::string& place)
        : joints_(joints) {
        for (std::size_t set = 0;; ++set) {
            const auto numbers = from.attributes.find("JOINTS_" + std::to_string(set));
            const auto weights = from.attributes.find("WEIGHTS_" + std::to_string(set));
            if (numbers == from.attributes.end() || weights == from.attributes.end()) break;
            numbers_.push_back(
                read_vertices<Vec4>(model, numbers->second, choice, "joints", place));
            weights_.push_back(
                read_vertices<Vec4>(model, weights->second, choice, "weights", place));
        }
        for (const auto& set : numbers_)
            for (const Vec4& four : set)
                for (int k = 0; k < 4; ++k)
                    if (!(four[k] >= 0.0f && four[k] < static_cast<float>(joints.size())))
                        gltf_fail(place, "a vertex hangs on joint " + std::to_string(four[k]) +
                                             " of a skin of " + std::to_string(joints.size()) +
                                             "; repair the skin");
    }

    /// The transform of vertex `i`. One without weights follows its first joint.
    [[nodiscard]] DMat4 at(std::size_t i) const {
        DMat4 sum(0.0);
        double total = 0.0;
        for (std::size_t set = 0; set < numbers_.size(); ++set)
            for (int k = 0; k < 4; ++k) {
                const double weight = weights_[set][i][k];
                if (weight == 0.0) continue;
                sum += weight * joints_[static_cast<std::size_t>(numbers_[set][i][k])];
                total += weight;
            }
        if (total == 0.0) return joints_[static_cast<std::size_t>(numbers_[0][i][0])];
        return sum / total;
    }

 private:
    const std::vector<DMat4>& joints_;
    std::vector<std::vector<Vec4>> numbers_;
    std::vector<std::vector<Vec4>> weights_;
};

/// Bends a mesh by its joints, which place it in the scene. Its fronts stay in front where they
/// mirror it.
/// Source: Khronos glTF 2.0 specification, 3.7.3 (skins).
inline void bend(const JointBlend& blend, const DVec3& origin, Mesh& mesh) {
    bool mirrors = false;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const DMat4 to_world = blend.at(i);
        const glm::dmat3 turn(to_world);
        const DVec3 at = DVec3(to_world * glm::dvec4(DVec3(mesh.positions[i]), 1.0)) - origin;
        mesh.positions[i] = Vec3(at);
        const double volume = glm::determinant(turn);
        if (i == 0) mirrors = volume < 0.0;
        if (mesh.normals.empty()) continue;
        // Normals go by the cofactors, which exist where the inverse does not.
        const glm::dmat3 cofactors(glm::cross(turn[1], turn[2]), glm::cross(turn[2], turn[0]),
                                   glm::cross(turn[0], turn[1]));
        const DVec3 normal = cofactors * DVec3(mesh.normals[i]);
        const double length = glm::length(normal);
        const double sign = volume < 0.0 ? -1.0 : 1.0;
        mesh.normals[i] = length > 0.0 ? Vec3(normal * (sign / length)) : Vec3(0.0f);
    }
    if (!mirrors) return;
    for (TriangleIndices& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace mir::detail
