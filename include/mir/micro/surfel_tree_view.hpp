// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/core/space.hpp"
#include "mir/micro/surfel.hpp"
#include "mir/micro/surfel_node.hpp"
#include "mir/micro/surfel_tree_options.hpp"

namespace mir {

/// What kernels read of a SurfelTree. A view of plain arrays; thread-safe.
template <Space S>
struct SurfelTreeView {
    static constexpr Space space = S;  ///< memory that the arrays lie in

    /// Most nodes on the way from the root to a disc.
    static constexpr std::uint32_t max_depth = SurfelTreeOptions::depth_limit;

    /// Index of the first node, where there is one.
    static constexpr std::uint32_t root = 0;

    const SurfelNode* nodes = nullptr;  ///< aligned to 16 bytes
    const Rgb* albedo = nullptr;        ///< of nodes: mean over the area below, 0..1
    const Surfel* surfels = nullptr;    ///< discs, counted by SurfelNode::first
    const float* area = nullptr;   ///< of nodes: of the pieces that the discs below stand for, m^2
    std::uint32_t node_count = 0;  ///< 0: there is no disc

    /// True when there is no disc: then there is no root.
    [[nodiscard]] MIR_HD bool empty() const { return node_count == 0; }
};

}  // namespace mir
