// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cstddef>
#include <cstdint>

namespace mir {

/// A number for each of the eight children of a node. Aligned so that the device fetches it as two
/// words.
struct alignas(16) ChildRow {
    static constexpr std::uint32_t width = 8;  ///< children of a node at most

    float at[width];  ///< by slot; without a value until written

    /// The number of slot `k` < width.
    [[nodiscard]] MIR_HD float operator[](std::size_t k) const { return at[k]; }
    /// The same, to be written.
    [[nodiscard]] MIR_HD float& operator[](std::size_t k) { return at[k]; }
};

/// One node of a wide bounding volume hierarchy, 256 bytes. The boxes of up to eight children, side
/// by side so that one vector instruction reads a plane of all of them, and what they are. A
/// trivially copyable value, the same on host and device.
struct alignas(64) WideNode {
    static constexpr std::uint32_t width = ChildRow::width;  ///< slots; some may be empty
    static constexpr std::int32_t inner = 0;                 ///< count of a child that is a node
    static constexpr std::int32_t empty = -1;                ///< count of a slot without a child

    /// Planes that bound the children, metres. Order: low x, high x, low y, high y, low z, high z.
    /// Those of empty slots lie so that no segment within the reach of the scene meets them.
    ChildRow planes[6];
    std::uint32_t ref[width];   ///< node, or first triangle of a leaf
    std::int32_t count[width];  ///< triangles of a leaf, `inner` or `empty`

    /// Lower plane on `axis` (0..2) of the box of a slot's child, metres.
    [[nodiscard]] MIR_HD float low(int axis, std::uint32_t slot) const {
        return planes[low_plane(axis)][slot];
    }
    /// Upper plane of the same box.
    [[nodiscard]] MIR_HD float high(int axis, std::uint32_t slot) const {
        return planes[low_plane(axis) + 1][slot];
    }
    /// Writes both planes of a slot's box on one axis, metres. `ref` and `count` stay as they are.
    MIR_HD void set_bounds(int axis, std::uint32_t slot, float low, float high) {
        planes[low_plane(axis)][slot] = low;
        planes[low_plane(axis) + 1][slot] = high;
    }
    /// Makes the slot one without a child, in a scene of that reach (metres).
    MIR_HD void set_empty(std::uint32_t slot, float reach) {
        for (int axis = 0; axis < 3; ++axis) set_bounds(axis, slot, reach, -reach);
        ref[slot] = 0;
        count[slot] = empty;
    }
    /// True when the slot's child is a node, whose number is ref[slot].
    [[nodiscard]] MIR_HD bool is_inner(std::uint32_t slot) const { return count[slot] == inner; }
    /// True when the slot's child is a leaf. An empty slot is neither.
    [[nodiscard]] MIR_HD bool is_leaf(std::uint32_t slot) const { return count[slot] > 0; }

 private:
    [[nodiscard]] MIR_HD static std::size_t low_plane(int axis) {
        return 2 * static_cast<std::size_t>(axis);
    }
};

static_assert(sizeof(WideNode) == 256);

}  // namespace mir
