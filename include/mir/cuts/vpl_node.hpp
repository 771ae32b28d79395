// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cstdint>

namespace mir {

/// A node of a VplTree: a range of its leaf order. A value that knows its children.
struct VplNode {
    std::uint32_t place = 0;  ///< in the order of a walk, parents before children
    std::uint32_t first = 0;  ///< its first leaf
    std::uint32_t count = 0;  ///< its leaves, at least 1

    /// True when it cannot be divided.
    [[nodiscard]] MIR_HD constexpr bool is_leaf() const { return count == 1; }
    /// The first half of its leaves. There must be two.
    [[nodiscard]] MIR_HD constexpr VplNode left() const { return {place + 1, first, count / 2}; }
    /// The second half of its leaves. There must be two.
    [[nodiscard]] MIR_HD constexpr VplNode right() const {
        return {place + 2 * (count / 2), first + count / 2, count - count / 2};
    }
    /// True for the same range.
    friend MIR_HD constexpr bool operator==(const VplNode&, const VplNode&) = default;
};

}  // namespace mir
