// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/cuts/vpl_tree_view.hpp"

#include <cmath>

namespace mir {

/// One of the VPLs that stand for a node where its deviation is estimated.
struct NodeSample {
    Vpl vpl;             ///< with the intensity of the whole node
    float share = 0.0f;  ///< in the node, 0..1

    static constexpr std::uint32_t most = 8;  ///< of a node

    /// How many a node has: all of its VPLs where they are few.
    [[nodiscard]] MIR_HD static std::uint32_t count_of(const VplNode& node) {
        return node.count < most ? node.count : most;
    }
    /// Sample `k` of a node: VPLs at fixed fractions of its weight.
    template <Space S>
    [[nodiscard]] MIR_HD static NodeSample of(const VplTreeView<S>& tree, const VplNode& node,
                                              std::uint32_t k) {
        const bool all = node.count <= most;
        const std::uint64_t u = (std::uint64_t{k} << 61) | std::uint64_t{1} << 60;
        const std::uint32_t leaf = all ? node.first + k : tree.pick(node, u);
        const float inverse = tree.inverse_probability(node, leaf);
        NodeSample sample{tree.leaves[leaf], all ? 1.0f / inverse : 1.0f / most};
        sample.vpl.intensity = sample.vpl.intensity * inverse;
        return sample;
    }
};

/// Mean and mean square of the luminance that a node's samples bring to a luxel.
struct SampleMoments {
    float mean = 0.0f;    ///< W m^-2 sr^-1
    float square = 0.0f;  ///< of W m^-2 sr^-1

    /// Adds what a sample of that share brings, W m^-2 sr^-1.
    MIR_HD void add(float share, const Rgb& light) {
        const float y = luminance(light);
        mean += share * y;
        square += share * y * y;
    }
    /// Square of W m^-2 sr^-1.
    [[nodiscard]] MIR_HD float variance() const { return square - mean * mean; }
};

/// The deviation of a node, from the sum of the variances of `luxels`.
[[nodiscard]] MIR_HD inline float root_of_mean(float variance, std::uint32_t luxels) {
    return std::sqrt(larger(variance, 0.0f) / static_cast<float>(luxels));
}

/// The group of a block whose luxels tell the deviation of a node. Another one for each node, with
/// luxels that count: `candidates(group)` is not zero. There must be one.
template <class Candidates>
[[nodiscard]] MIR_HD std::uint32_t telling_group(const VplNode& node, std::uint32_t groups,
                                                 const Candidates& candidates) {
    std::uint32_t group = node.first * 7 % groups;
    while (candidates(group) == 0) group = (group + 1) % groups;
    return group;
}

/// The most that a node's VPLs can bring to luxels in a box, W m^-2 sr^-1. The luxel reflects all
/// light; `bound` is that of the geometry term, m^-2.
[[nodiscard]] MIR_HD inline float largest_light(Vec3 low, Vec3 high, const VplBounds& vpls,
                                                std::uint32_t count, float bound) {
    const Vec3 gap = glm::max(glm::max(vpls.low - high, low - vpls.high), Vec3(0.0f));
    const float geometry = smaller(1.0f / length_squared(gap), bound);
    return static_cast<float>(count) * vpls.most * geometry;
}

}  // namespace mir
