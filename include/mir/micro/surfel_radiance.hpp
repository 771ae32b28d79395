// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/micro/surfel_patches.hpp"

#include <vector>

namespace mir {

/// Radiance that leaves the two sides of a disc, W m^-2 sr^-1. Of a node it is the mean over the
/// discs below; it is the same in all directions.
struct SurfelRadiance {
    Rgb front;  ///< on the side of the normals
    Rgb back;   ///< against the normals

    /// Of the side that is asked for.
    [[nodiscard]] MIR_HD Rgb of(bool front_side) const { return front_side ? front : back; }
};

/// Mean of the light of an inner node's children by area: relative error below 2^-22.
template <Space S>
[[nodiscard]] MIR_HD SurfelRadiance mean_of_children(const SurfelTreeView<S>& tree,
                                                     std::uint32_t index,
                                                     const SurfelRadiance* radiance) {
    const auto mean = [](Rgb a, Rgb b, float share) { return a * (1.0f - share) + b * share; };
    const std::uint32_t right_index = tree.nodes[index].right;
    const float right_area = tree.area[right_index];
    const float share = right_area / (tree.area[index + 1] + right_area);
    const SurfelRadiance& left = radiance[index + 1];
    const SurfelRadiance& right = radiance[right_index];
    return {mean(left.front, right.front, share), mean(left.back, right.back, share)};
}

/// Fills the inner nodes with the means of their children, from the leaves up. `radiance` has an
/// element for each node.
inline void average_radiance(const SurfelTree& tree, std::span<SurfelRadiance> radiance) {
    const SurfelTreeView<Space::host> view = tree.view();
    for (std::uint32_t i = view.node_count; i-- > 0;)
        if (!view.nodes[i].is_leaf()) radiance[i] = mean_of_children(view, i, radiance.data());
}

/// Lights both sides of every patch. `light(face, number)` is the radiance that white discs in the
/// place of a SurfelFace would send out, W m^-2 sr^-1; each disc sends out that times its albedo.
/// `number` names the face among all, for random numbers: twice that of the patch, plus 1 for its
/// back. Faces whose albedo is black are not asked. Element i belongs to node i. The same for any
/// number of threads.
template <class Light, Executor E>
std::vector<SurfelRadiance> light_surfels(const SurfelPatches& patches, const Light& light,
                                          float ray_offset, E& executor) {
    const SurfelTreeView<Space::host> tree = patches.tree().view();
    std::vector<SurfelRadiance> radiance(tree.node_count);
    for_each_reflecting_patch(patches, executor, [&](std::size_t patch) {
        const std::uint32_t top = patches.nodes()[patch];
        const Rgb front = light(SurfelFace{tree, top, true, ray_offset}, 2 * patch);
        const Rgb back = light(SurfelFace{tree, top, false, ray_offset}, 2 * patch + 1);
        for (std::uint32_t i = top; i < top + 2 * tree.nodes[top].count - 1; ++i)
            if (tree.nodes[i].is_leaf())
                radiance[i] = {front * tree.albedo[i], back * tree.albedo[i]};
    });
    average_radiance(patches.tree(), radiance);
    return radiance;
}

}  // namespace mir
