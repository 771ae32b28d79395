// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_node.hpp"
#include "mir/core/math.hpp"
#include "mir/core/strict_float.hpp"

#include <cstring>

namespace mir {

/// The boxes of a WideNode on a grid of its own, in 64 bytes. The device fetches them as four words
/// where the node itself takes twelve: for walks that may visit a few nodes too many. Plane b of an
/// axis lies at origin + b step, b from 0 to 255; every box holds that of the WideNode with the
/// margin of quantised(). Made from a WideNode, kept beside it under the same number. Source:
/// Ylitie, Karras and Laine, "Efficient incoherent ray traversal on GPUs through compressed wide
/// BVHs", HPG 2017.
struct alignas(64) QuantisedNode {
    static constexpr std::uint32_t words_per_row = WideNode::width / 4;  ///< four children each

    Vec3 origin{0};                         ///< plane 0 of each axis, metres
    std::uint8_t exponents[3] = {0, 0, 0};  ///< of the steps, with the bias of single precision
    std::uint8_t inner = 0;                 ///< bit k: child k is a node
    /// Bytes of eight children, four to a word. Order: low x, high x, low y, high y, low z, high z.
    std::uint32_t rows[6][words_per_row] = {};

    /// Distance of neighbouring planes, metres: a power of two.
    [[nodiscard]] MIR_HD float step(int axis) const {
        const std::uint32_t bits = static_cast<std::uint32_t>(exponents[axis]) << 23;
        float value = 0.0f;
        memcpy(&value, &bits, sizeof value);
        return value;
    }
    /// Place of the planes that bound children on one side.
    [[nodiscard]] MIR_HD static std::size_t row_of(int axis, bool upper) {
        return 2 * static_cast<std::size_t>(axis) + (upper ? 1 : 0);
    }
    /// Number of the plane that bounds child `slot`.
    [[nodiscard]] MIR_HD std::uint32_t plane(int axis, bool upper, std::uint32_t slot) const {
        return rows[row_of(axis, upper)][slot / 4] >> 8 * (slot % 4) & 0xFFu;
    }
};

static_assert(sizeof(QuantisedNode) == 64);

namespace detail {

/// The grid of one axis.
struct NodeGrid {
    float origin = 0.0f;
    std::uint32_t exponent = 1;
    float step = 0.0f;
};

/// A grid of 256 planes, more than two of them beyond [low, high] each side.
MIR_HD inline NodeGrid grid_over(float low, float high) {
    const float wanted = larger(strict::sub(high, low) * (1.0f / 240.0f), 0x1p-125f);
    NodeGrid grid;
    std::uint32_t bits = 0;
    memcpy(&bits, &wanted, sizeof bits);
    grid.exponent = (bits >> 23) + 1;
    bits = grid.exponent << 23;
    memcpy(&grid.step, &bits, sizeof bits);
    grid.origin = strict::sub(low, 3.0f * grid.step);
    return grid;
}

/// Number of the plane at x or beyond it on the given side. A hundredth of a step at least is to
/// spare.
MIR_HD inline std::uint32_t plane_beyond(const NodeGrid& grid, float x, bool upper) {
    const float steps = strict::div(strict::sub(x, grid.origin), grid.step);
    const float beyond = upper ? ceilf(steps + 0.02f) : floorf(steps - 0.02f);
    return static_cast<std::uint32_t>(smaller(larger(beyond, 0.0f), 255.0f));
}

/// One axis of a node's children on a grid.
MIR_HD inline void quantise_axis(const WideNode& node, int axis, float margin, QuantisedNode& q) {
    float low = 0.0f, high = 0.0f;
    bool found = false;
    for (std::uint32_t k = 0; k < WideNode::width; ++k) {
        if (node.count[k] == WideNode::empty) continue;
        low = found ? smaller(node.low(axis, k), low) : node.low(axis, k);
        high = found ? larger(node.high(axis, k), high) : node.high(axis, k);
        found = true;
    }
    const NodeGrid grid = grid_over(strict::sub(low, margin), strict::add(high, margin));
    q.origin[axis] = grid.origin;
    q.exponents[axis] = static_cast<std::uint8_t>(grid.exponent);
    for (std::uint32_t k = 0; k < WideNode::width; ++k) {
        const bool is_empty = node.count[k] == WideNode::empty;
        const float child_low = strict::sub(node.low(axis, k), margin);
        const float child_high = strict::add(node.high(axis, k), margin);
        // Empty slots: turned inside out, which next to no shaft meets.
        const std::uint32_t from = is_empty ? 255u : plane_beyond(grid, child_low, false);
        const std::uint32_t to = is_empty ? 0u : plane_beyond(grid, child_high, true);
        q.rows[QuantisedNode::row_of(axis, false)][k / 4] |= from << 8 * (k % 4);
        q.rows[QuantisedNode::row_of(axis, true)][k / 4] |= to << 8 * (k % 4);
    }
}

}  // namespace detail

/// The boxes of a node, grown by `margin` metres, on a grid. And by a hundredth of a step more.
/// `margin` is 8 e M or more: it holds the rounding of the grid's origin, too. Boxes of empty slots
/// mean nothing.
[[nodiscard]] MIR_HD inline QuantisedNode quantised(const WideNode& node, float margin) {
    QuantisedNode q;
    for (std::uint32_t k = 0; k < WideNode::width; ++k)
        if (node.is_inner(k)) q.inner = static_cast<std::uint8_t>(q.inner | 1u << k);
    for (int axis = 0; axis < 3; ++axis) detail::quantise_axis(node, axis, margin, q);
    return q;
}

}  // namespace mir
