// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/axis_step.hpp"
#include "mir/accel/exact/triangle_rows.hpp"
#include "mir/accel/wide/quantised_node.hpp"

// How shafts read the planes of a node's eight children: as numbers [k] to which steps and rows
// that were made for coordinates are adapted once per node.

namespace mir::detail {

/// Row `upper` of an axis of a WideNode: coordinates, metres.
MIR_HD inline const ChildRow& plane_row(const WideNode& node, int axis, bool upper) {
    return node.planes[QuantisedNode::row_of(axis, upper)];
}

MIR_HD inline AxisStep adapted(const WideNode&, int /*axis*/, AxisStep step) { return step; }
MIR_HD inline AffineRow adapted(const WideNode&, AffineRow row) { return row; }

/// What numbers of planes are added to. The sum of it and a byte is a byte put among the digits of
/// a float, which costs the device one operation.
inline constexpr float plane_bias = 32768.0f;

/// plane_bias and byte number `k` of a word.
MIR_HD inline float biased_plane(std::uint32_t word, std::uint32_t k) {
#if defined(__CUDA_ARCH__)
    return __uint_as_float(__byte_perm(word, 0x47000000u, 0x7404u | k << 4));
#else
    return plane_bias + static_cast<float>(word >> 8 * k & 0xFFu);
#endif
}

/// One row of a QuantisedNode: biased numbers of planes.
struct PlaneWords {
    std::uint32_t word[QuantisedNode::words_per_row];

    [[nodiscard]] MIR_HD float operator[](std::uint32_t k) const {
        return biased_plane(word[k / 4], k % 4);
    }
};

/// Both rows of an axis are there already: words are chosen, not fetched.
MIR_HD inline PlaneWords plane_row(const QuantisedNode& node, int axis, bool upper) {
    const std::uint32_t* const low = node.rows[QuantisedNode::row_of(axis, false)];
    const std::uint32_t* const high = node.rows[QuantisedNode::row_of(axis, true)];
    return {{upper ? high[0] : low[0], upper ? high[1] : low[1]}};
}

/// Sums of biased products lose 2^-8 of a step, which boxes have in reserve.
MIR_HD inline AxisStep adapted(const QuantisedNode& node, int axis, AxisStep step) {
    const float inverse = strict::mul(step.inverse, node.step(axis));
    const float base = loose::mul_sub(node.origin[axis], step.inverse, step.offset);
    return {inverse, loose::mul_sub(plane_bias, inverse, base)};
}

/// The row with a hundredth of a step of each axis added. Sums of biased products lose that beyond
/// the reserve of the node's boxes.
MIR_HD inline AffineRow adapted(const QuantisedNode& node, AffineRow row) {
    const float of_axis[3] = {row.x, row.y, row.z};
    float per_plane[3];
    float constant = row.w;
    for (int axis = 0; axis < 3; ++axis) {
        per_plane[axis] = strict::mul(of_axis[axis], node.step(axis));
        const float at_origin =
            loose::mul_add(of_axis[axis], node.origin[axis], 0.01f * fabsf(per_plane[axis]));
        constant = strict::add(constant, loose::mul_add(-plane_bias, per_plane[axis], at_origin));
    }
    return {per_plane[0], per_plane[1], per_plane[2], constant};
}

}  // namespace mir::detail
