// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/micro/surfel_face.hpp"
#include "mir/micro/surfel_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace mir {

/// Which discs share the light that falls on them.
struct SurfelPatchOptions {
    float max_area = 0.0f;      ///< of their pieces together, m^2; 0: each disc is alone
    float least_cosine = 0.8f;  ///< of the angle between their normals and the mean of those
};

/// The patches of a scene. Nodes of a tree whose discs share the light that falls on them, while
/// each reflects it with its own albedo. Together they hold every disc once. A scene of many small
/// triangles has far fewer patches than discs. Immutable; const use from any thread. Source:
/// patches and elements of radiosity (Cohen, Greenberg, Immel and Brock, "An efficient radiosity
/// approach for realistic image synthesis", IEEE CG&A 6(3), 1986).
class SurfelPatches {
 public:
    /// The largest nodes within `options` and the sphere of a largest patch. Single discs may be
    /// larger. The tree must outlive it.
    explicit SurfelPatches(const SurfelTree& tree, const SurfelPatchOptions& options = {})
        : tree_(&tree) {
        for (std::uint32_t i = 0; i < tree.nodes().size();) {
            const SurfelNode& node = tree.nodes()[i];
            if (!is_patch(tree, i, options)) {
                ++i;
                continue;
            }
            nodes_.push_back(i);
            i += 2 * node.count - 1;
        }
    }

    /// These nodes, in the order of the tree.
    SurfelPatches(const SurfelTree& tree, std::vector<std::uint32_t> nodes)
        : tree_(&tree), nodes_(std::move(nodes)) {}

    /// In the order of the tree.
    [[nodiscard]] std::span<const std::uint32_t> nodes() const { return nodes_; }
    /// Whose nodes they are.
    [[nodiscard]] const SurfelTree& tree() const { return *tree_; }
    /// Number of patches.
    [[nodiscard]] std::size_t size() const { return nodes_.size(); }

 private:
    /// One surface, not one behind the other. No thicker than a bent one whose normals turn so far,
    /// and of one material. Of a right triangle with two equal sides the longest lies across the
    /// sphere, whose radius is the root of the area.
    static bool is_patch(const SurfelTree& tree, std::uint32_t index, const SurfelPatchOptions& o) {
        const SurfelNode& node = tree.nodes()[index];
        if (node.is_leaf()) return true;
        const float bend = std::sqrt((1.0f - node.cos_angle) / (1.0f + node.cos_angle));
        if (!(tree.area()[index] <= o.max_area) ||
            !(node.radius * node.radius <= 1.05f * o.max_area) ||
            !(node.cos_angle >= o.least_cosine) ||
            !(node.thickness <= (bend + 0.02f) * node.radius))
            return false;
        const auto discs = tree.surfels().subspan(node.first, node.count);
        return std::all_of(discs.begin(), discs.end(), [&](const Surfel& disc) {
            return disc.material == discs.front().material;
        });
    }

    const SurfelTree* tree_;
    std::vector<std::uint32_t> nodes_;
};

/// Calls visit(patch) for every patch that reflects light. In any order, from any thread; `patch`
/// is its number.
template <class Visit, Executor E>
void for_each_reflecting_patch(const SurfelPatches& patches, E& executor, const Visit& visit) {
    constexpr std::size_t part = 64;
    executor.for_each((patches.size() + part - 1) / part, [&](std::size_t p) {
        for (std::size_t i = p * part; i < std::min(patches.size(), (p + 1) * part); ++i)
            if (!is_black(patches.tree().albedo()[patches.nodes()[i]])) visit(i);
    });
}

}  // namespace mir
