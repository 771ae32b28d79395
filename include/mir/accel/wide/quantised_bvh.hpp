// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/node_links.hpp"
#include "mir/accel/wide/quantised_node.hpp"
#include "mir/accel/wide/wide_bvh_view.hpp"

namespace mir {

/// A hierarchy with its nodes in short, for walks that visit many.
template <Space S>
struct QuantisedBvhView {
    static constexpr Space space = S;  ///< of the memory of all

    WideBvhView<S> exact;                  ///< the hierarchy itself
    const QuantisedNode* boxes = nullptr;  ///< of the nodes of `exact`, by their numbers
    const NodeLinks* links = nullptr;      ///< of the same
};

/// Kernel over the nodes of a hierarchy.
template <Space S>
struct QuantiseNodes {
    WideBvhView<S> bvh;              ///< whose nodes are read
    QuantisedNode* boxes = nullptr;  ///< one for each node, by its number
    NodeLinks* links = nullptr;      ///< as above

    /// Writes the boxes of node `i` and its links. The margin is 2^-20 of the hierarchy's
    /// reach.
    MIR_HD void operator()(std::uint32_t i) const {
        // 2^-20 reach is 24 e M.
        boxes[i] = quantised(bvh.nodes[i], 0x1p-20f * bvh.reach);
        links[i] = links_of(bvh.nodes[i]);
    }
};

}  // namespace mir
