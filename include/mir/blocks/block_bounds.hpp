// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lanes.hpp"
#include "mir/core/math.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"
#include "mir/data/vpl.hpp"

#include <algorithm>
#include <limits>

namespace mir::blocks {

/// What a block's luxels have in common, for tests that reject whole blocks. Every test is
/// lossless: it is true only if faces() is false for every luxel of the block. That needs no
/// margin: rounding to the nearest keeps the order of numbers and is the same for both signs, so
/// that the operations of faces() in their order, done to the ends of intervals, bound what faces()
/// finds, provided that neither is compiled with fused products and sums (-ffp-contract=off). So a
/// wall along an axis is thrown away for VPLs on itself.
struct BlockBounds {
    Vec3 low{std::numeric_limits<float>::max()};  ///< corners of a box around the positions
    Vec3 high{std::numeric_limits<float>::lowest()};
    Vec3 normal_low{1.0f};  ///< and of one around the normals
    Vec3 normal_high{-1.0f};

    /// True when every luxel lies behind the VPL's tangent plane.
    [[nodiscard]] bool behind(const Vpl& vpl) const {
        return largest_dot(low - vpl.position, high - vpl.position, vpl.normal, vpl.normal) <= 0.0f;
    }

    /// True when the VPL lies behind every luxel's tangent plane.
    [[nodiscard]] bool turned_away_from(Vec3 position) const {
        return largest_dot(position - high, position - low, normal_low, normal_high) <= 0.0f;
    }

    /// Squared distance from a point to the box.
    [[nodiscard]] float distance_squared(Vec3 p) const {
        return length_squared(glm::max(glm::max(low - p, p - high), Vec3(0.0f)));
    }

 private:
    /// Upper bound of a dot product of two vectors that lie in boxes. It holds for glm::dot() with
    /// its rounding. Of each two products that comes first which may be infinite where the other is
    /// no number, because differences overflowed: glm::max() forgets a second argument that is no
    /// number.
    static float largest_dot(Vec3 a_low, Vec3 a_high, Vec3 b_low, Vec3 b_high) {
        const Vec3 largest = glm::max(glm::max(a_low * b_low, a_low * b_high),
                                      glm::max(a_high * b_high, a_high * b_low));
        return glm::dot(largest, Vec3(1.0f));
    }
};

/// Bounds of a block, sixteen luxels at a time. There is a box for each lane, widened without a
/// branch.
class BoundsOfLanes {
 public:
    BoundsOfLanes() {
        const BlockBounds nothing;
        for (int axis = 0; axis < 3; ++axis) {
            std::ranges::fill(low_[axis].at, nothing.low[axis]);
            std::ranges::fill(high_[axis].at, nothing.high[axis]);
            std::ranges::fill(normal_low_[axis].at, nothing.normal_low[axis]);
            std::ranges::fill(normal_high_[axis].at, nothing.normal_high[axis]);
        }
    }

    /// Adds those of sixteen luxels whose bit is set in `on`.
    void add(SoaView<const Hit> group, std::uint32_t on) {
        for (std::uint32_t k = 0; k < mir::detail::lane_count; ++k) {
            const Hit hit = group.load(k);
            const bool counts = (on & mir::detail::lane_bits[k]) != 0;
            for (int axis = 0; axis < 3; ++axis) {
                const float p = hit.position[axis];
                const float n = hit.normal[axis];
                low_[axis].at[k] = smaller(counts ? p : low_[axis].at[k], low_[axis].at[k]);
                high_[axis].at[k] = larger(counts ? p : high_[axis].at[k], high_[axis].at[k]);
                normal_low_[axis].at[k] =
                    smaller(counts ? n : normal_low_[axis].at[k], normal_low_[axis].at[k]);
                normal_high_[axis].at[k] =
                    larger(counts ? n : normal_high_[axis].at[k], normal_high_[axis].at[k]);
            }
        }
    }

    /// Around all that were added.
    [[nodiscard]] BlockBounds all() const {
        BlockBounds bounds;
        for (int axis = 0; axis < 3; ++axis) {
            bounds.low[axis] = std::ranges::min(low_[axis].at);
            bounds.high[axis] = std::ranges::max(high_[axis].at);
            bounds.normal_low[axis] = std::ranges::min(normal_low_[axis].at);
            bounds.normal_high[axis] = std::ranges::max(normal_high_[axis].at);
        }
        return bounds;
    }

 private:
    mir::detail::LaneFloats low_[3];
    mir::detail::LaneFloats high_[3];
    mir::detail::LaneFloats normal_low_[3];
    mir::detail::LaneFloats normal_high_[3];
};

}  // namespace mir::blocks
