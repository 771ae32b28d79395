// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/space.hpp"
#include "mir/cuts/detail/high_product.hpp"
#include "mir/cuts/vpl_bounds.hpp"
#include "mir/cuts/vpl_node.hpp"
#include "mir/data/vpl.hpp"

#include <cstdint>

namespace mir {

/// A VplTree as kernels read it. A view; thread-safe.
template <Space S>
struct VplTreeView {
    static constexpr Space space = S;  ///< of the memory behind it

    const Vpl* leaves = nullptr;             ///< in leaf order
    const std::uint64_t* sums = nullptr;     ///< of the pick weights before each leaf, and of all
    const VplBounds* node_bounds = nullptr;  ///< by VplNode::place
    std::uint32_t count = 0;                 ///< leaves

    /// The node of all leaves. There must be some.
    [[nodiscard]] MIR_HD VplNode root() const { return {0, 0, count}; }
    /// Sum of the pick weights of a node's leaves.
    [[nodiscard]] MIR_HD std::uint64_t weight(const VplNode& node) const {
        return sums[node.first + node.count] - sums[node.first];
    }
    /// Bounds of a node.
    [[nodiscard]] MIR_HD const VplBounds& bounds(const VplNode& node) const {
        return node_bounds[node.place];
    }

    /// The leaf that a number picks. Its probability is its share in the node's weight. `u` is a
    /// fraction of 2^64.
    [[nodiscard]] MIR_HD std::uint32_t pick(const VplNode& node, std::uint64_t u) const {
        const std::uint64_t at = sums[node.first] + detail::high_product(u, weight(node));
        // The last leaf with no more than that before it.
        std::uint32_t leaf = node.first;
        std::uint32_t left = node.count;
        while (left > 1) {
            const std::uint32_t half = left / 2;
            leaf = sums[leaf + half] <= at ? leaf + half : leaf;
            left -= half;
        }
        return leaf;
    }

    /// The inverse of the probability with which a node picks one of its leaves.
    [[nodiscard]] MIR_HD float inverse_probability(const VplNode& node, std::uint32_t leaf) const {
        const std::uint64_t own = sums[leaf + 1] - sums[leaf];
        return static_cast<float>(static_cast<double>(weight(node)) / static_cast<double>(own));
    }
};

}  // namespace mir
