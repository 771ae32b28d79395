// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_check.hpp"
#include "mir/core/math.hpp"

#include <tiny_gltf.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace mir::detail {

/// A node of the chosen scene and its transform to world space. Products of transforms are formed
/// in double precision, as the numbers of JSON are.
struct PlacedNode {
    std::size_t node = 0;
    DMat4 to_world{1.0};
    /// Turns what has an orientation but no size, a light or a camera. Rotations of this node and
    /// of those above, whose scale tilts and mirrors it. The node's own scale does not count.
    DMat4 turn{1.0};
    bool is_visible = true;  ///< false: it has no meshes and lights, but its camera
};

/// False when a node hides itself and those below.
/// Source: Khronos, KHR_node_visibility.
inline bool shows_itself(const tinygltf::Node& node) {
    const auto found = node.extensions.find("KHR_node_visibility");
    return found == node.extensions.end() || !found->second.Has("visible") ||
           found->second.Get("visible").Get<bool>();
}

inline std::string node_place(const tinygltf::Model& model, std::size_t index) {
    return gltf_place("node", index, model.nodes[index].name);
}

/// `count` numbers within the range of floats, or the default when the file gives none.
template <std::size_t count>
std::array<double, count> numbers_or(const std::vector<double>& given,
                                     std::array<double, count> otherwise, const char* what,
                                     const std::string& place) {
    if (given.empty()) return otherwise;
    if (given.size() != count)
        gltf_fail(place, std::string(what) + " has " + std::to_string(given.size()) +
                             " numbers instead of " + std::to_string(count) + "; repair it");
    for (std::size_t i = 0; i < count; ++i) {
        (void)checked_float(given[i], what, place);
        otherwise[i] = given[i];
    }
    return otherwise;
}

/// Translation x rotation x scale. The rotation is a quaternion (x, y, z, w) of any length.
inline DMat4 compose(const std::array<double, 3>& t, const std::array<double, 4>& q,
                     const std::array<double, 3>& s, const std::string& place) {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0.0))
        gltf_fail(place, "its rotation is no quaternion (all zeros); repair or remove it");
    const double x = q[0] / length;
    const double y = q[1] / length;
    const double z = q[2] / length;
    const double w = q[3] / length;
    DMat4 m(1.0);
    m[0] = s[0] * glm::dvec4(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0);
    m[1] = s[1] * glm::dvec4(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0);
    m[2] = s[2] * glm::dvec4(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0);
    m[3] = {t[0], t[1], t[2], 1.0};
    return m;
}

/// The scale of a node along its axes.
inline std::array<double, 3> scale_of(const tinygltf::Node& node, const std::string& place) {
    return numbers_or<3>(node.scale, {1, 1, 1}, "scale", place);
}

/// What is left of a scale for orientations below it. Three negative numbers mirror at a point: no
/// plane and no axis is left that could turn anything.
inline std::array<double, 3> scale_of_turns(std::array<double, 3> s) {
    if (s[0] < 0.0 && s[1] < 0.0 && s[2] < 0.0)
        for (double& along : s) along = -along;
    return s;
}

/// Transform of a node to its parent, with `scale` instead of its own. A matrix is taken whole.
inline DMat4 node_transform(const tinygltf::Node& node, const std::array<double, 3>& scale,
                            const std::string& place) {
    if (node.matrix.empty())
        return compose(numbers_or<3>(node.translation, {0, 0, 0}, "translation", place),
                       numbers_or<4>(node.rotation, {0, 0, 0, 1}, "rotation", place), scale, place);
    const auto numbers = numbers_or<16>(node.matrix, {}, "matrix", place);
    DMat4 m(1.0);
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            m[static_cast<int>(column)][static_cast<int>(row)] = numbers[4 * column + row];
    if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
        gltf_fail(place, "its matrix is not affine (the last row is not 0 0 0 1); repair it");
    return m;
}

/// `m` itself.
/// @throws Error(invalid_input) when products of nodes leave the range of floats.
inline const DMat4& checked_matrix(const DMat4& m, const std::string& place) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            (void)checked_float(m[column][row], "its transform to the world", place);
    return m;
}

/// Parent of every node, -1 for roots.
/// @throws Error(invalid_input) when a node has two parents or is its own ancestor.
inline std::vector<int> node_parents(const tinygltf::Model& model) {
    std::vector<int> parents(model.nodes.size(), -1);
    for (std::size_t i = 0; i < parents.size(); ++i)
        for (int child : model.nodes[i].children) {
            const auto c = checked_index(child, parents.size(), "node", node_place(model, i));
            if (parents[c] >= 0)
                gltf_fail(node_place(model, c), "it is a child twice, of node " +
                                                    std::to_string(parents[c]) + " and of node " +
                                                    std::to_string(i) +
                                                    " (glTF nodes form trees); repair the tree");
            parents[c] = static_cast<int>(i);
        }
    // With one parent each, whatever cannot be reached from a root hangs on a cycle.
    std::vector<char> reached(parents.size(), 0);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < parents.size(); ++i)
        if (parents[i] < 0) open.push_back(i);
    while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        reached[i] = 1;
        for (int child : model.nodes[i].children) open.push_back(static_cast<std::size_t>(child));
    }
    for (std::size_t i = 0; i < parents.size(); ++i)
        if (reached[i] == 0)
            gltf_fail(node_place(model, i),
                      "it is its own ancestor or below such a node (the children form a cycle); "
                      "repair the tree");
    return parents;
}

/// Roots of the scene to show. The default one, else the first one, else every root node.
inline std::vector<std::size_t> scene_roots(const tinygltf::Model& model, SceneReport& report) {
    const std::vector<int> parents = node_parents(model);
    std::vector<std::size_t> roots;
    if (model.scenes.empty()) {
        for (std::size_t i = 0; i < parents.size(); ++i)
            if (parents[i] < 0) roots.push_back(i);
        report.notes.emplace_back("the file has no scene: every root node was placed");
        return roots;
    }
    const int chosen = model.defaultScene >= 0 ? model.defaultScene : 0;
    const auto index = checked_index(chosen, model.scenes.size(), "scene", "scene");
    const std::string place = gltf_place("scene", index, model.scenes[index].name);
    std::vector<char> listed(parents.size(), 0);
    for (int node : model.scenes[index].nodes) {
        const auto root = checked_index(node, parents.size(), "node", place);
        if (parents[root] >= 0 || listed[root] != 0)
            gltf_fail(place, "it lists node " + std::to_string(root) +
                                 ", which is the child of another node or listed twice; repair "
                                 "the list");
        listed[root] = 1;
        roots.push_back(root);
    }
    if (model.scenes.size() > 1)
        report.notes.push_back("the file has " + std::to_string(model.scenes.size()) +
                               " scenes: scene " + std::to_string(index) + " was read");
    return roots;
}

/// Every node of the scene to show, parents before children. In the order of the file's lists.
inline std::vector<PlacedNode> placed_nodes(const tinygltf::Model& model, SceneReport& report) {
    const std::vector<std::size_t> roots = scene_roots(model, report);
    std::vector<PlacedNode> open;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) open.push_back({*root});
    std::vector<PlacedNode> placed;
    while (!open.empty()) {
        PlacedNode next = open.back();
        open.pop_back();
        const tinygltf::Node& node = model.nodes[next.node];
        const std::string place = node_place(model, next.node);
        const std::array<double, 3> scale = scale_of(node, place);
        // From here on both are the node's own; before they were what its parent hands down.
        next.to_world = next.to_world * node_transform(node, scale, place);
        const DMat4 handed_down = next.turn * node_transform(node, scale_of_turns(scale), place);
        next.turn = next.turn * node_transform(node, {1, 1, 1}, place);
        next.is_visible = next.is_visible && shows_itself(node);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            open.push_back(
                {static_cast<std::size_t>(*child), next.to_world, handed_down, next.is_visible});
        placed.push_back(next);
    }
    return placed;
}

}  // namespace mir::detail
