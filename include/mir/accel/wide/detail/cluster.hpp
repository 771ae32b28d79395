// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/detail/binary_node.hpp"

namespace mir::detail {

/// A part of the scene for which a binary tree is made already. Its box and its root.
struct alignas(16) Cluster {
    Vec3 low{0};
    std::uint32_t node = 0;
    Vec3 high{0};
    std::uint32_t spare = 0;
};

/// Both parts as one, below the node `node`. Does not depend on their order, except for zeros'
/// signs.
MIR_HD inline Cluster joined(const Cluster& a, const Cluster& b, std::uint32_t node) {
    return {lower_corner(a.low, b.low), node, upper_corner(a.high, b.high), 0};
}

}  // namespace mir::detail
