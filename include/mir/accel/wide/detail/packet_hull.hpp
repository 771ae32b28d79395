// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/axis_step.hpp"
#include "mir/accel/wide/wide_node.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/core/lanes.hpp"
#include "mir/core/strict_float.hpp"

#include <cstdint>
#include <limits>

namespace mir::detail {

/// The segments from one origin to the points of a packet, tested together. A node's eight children
/// are tested against all of them at once. A child that it refuses no segment meets; whoever walks
/// for long asks each segment about the others only.
///
/// Why no child is refused that a segment needs. Let the segment go d along an axis and hold X, of
/// the share t, which lies in the child's box by 14 e M (wide_traverse.hpp, whose bounds of
/// rounding hold here: the operations are the same). Where all points lie above the origin, d is
/// between the steps to the lowest and the highest of them. The share at which the highest passes
/// the lower plane is no later than t, and that at which the lowest passes the upper one no
/// earlier: each belongs to a segment that goes farther, or less far, while X keeps 0.5 e M to
/// spare. So below. Where points lie on both sides, both are bounds from below, one for
/// children on either side.
class PacketHull {
 public:
    /// Of the points whose bit is set in `active`, one at least; metres. All lie within `reach`,
    /// that of the hierarchy.
    PacketHull(Vec3 origin, const PointPacket& points, std::uint32_t active, float reach) {
        const float shortest = shortest_step(reach);
        const float* const coordinates[3] = {points.x, points.y, points.z};
        for (int axis = 0; axis < 3; ++axis)
            set(axis, origin[axis], ends_of(coordinates[axis], active), shortest);
    }

    /// Bit k: segments may meet the box of child k. What it says of empty slots means nothing.
    template <InstructionSet Set>
    [[nodiscard]] std::uint32_t met(const WideNode& node) const {
        const auto& planes = node.planes;
        const ChildRow& leave_x = planes[leaving_[0]];
        const ChildRow& leave_y = planes[leaving_[1]];
        const ChildRow& leave_z = planes[leaving_[2]];
        const Axis x = axes_[0];
        const Axis y = axes_[1];
        const Axis z = axes_[2];
        SlotTruths truths;
        for (std::uint32_t k = 0; k < WideNode::width; ++k) {
            const float begin = larger(larger(begins(x, planes[0][k], planes[1][k]),
                                              begins(y, planes[2][k], planes[3][k])),
                                       begins(z, planes[4][k], planes[5][k]));
            const float end =
                smaller(smaller(passes(leave_x[k], x.leaves), 1.0f),
                        smaller(passes(leave_y[k], y.leaves), passes(leave_z[k], z.leaves)));
            truths.at[k] = begin <= end ? -1 : 0;
        }
        return bits_of<Set>(truths);
    }

 private:
    struct Axis {
        AxisStep rises;   ///< to the highest point: for lower planes; 0 where all lie below
        AxisStep falls;   ///< to the lowest point: for upper planes; 0 where none lies below
        AxisStep leaves;  ///< of the nearest point; always 1 where they are on both sides
    };
    struct Ends {
        float low;
        float high;
    };

    [[nodiscard]] static float passes(float plane, AxisStep step) {
        return loose::mul_sub(plane, step.inverse, step.offset);
    }
    [[nodiscard]] static float begins(Axis axis, float low, float high) {
        return larger(larger(passes(low, axis.rises), passes(high, axis.falls)), 0.0f);
    }

    [[nodiscard]] static Ends ends_of(const float* coordinates, std::uint32_t active) {
        constexpr float beyond = std::numeric_limits<float>::infinity();
        LaneFloats low;
        LaneFloats high;
        for (std::uint32_t k = 0; k < lane_count; ++k) {
            const bool counts = (active & lane_bits[k]) != 0;
            low.at[k] = counts ? coordinates[k] : beyond;
            high.at[k] = counts ? coordinates[k] : -beyond;
        }
        for (std::uint32_t step = lane_count / 2; step > 0; step /= 2)
            for (std::uint32_t k = 0; k < step; ++k) {
                low.at[k] = smaller(low.at[k], low.at[k + step]);
                high.at[k] = larger(high.at[k], high.at[k + step]);
            }
        return {low.at[0], high.at[0]};
    }

    void set(int axis, float from, Ends ends, float shortest) {
        const bool is_above = ends.low >= from;
        const bool is_below = ends.high < from;
        const float down = strict::sub(from, ends.low);
        const float up = strict::sub(ends.high, from);
        Axis& a = axes_[axis];
        a = {{0.0f, 0.0f}, {0.0f, 0.0f}, {0.0f, -1.0f}};
        if (!is_below) a.rises = face_step(from, up, 1.0f, shortest);
        if (!is_above) a.falls = face_step(from, down, -1.0f, shortest);
        if (is_above) a.leaves = face_step(from, -down, 1.0f, shortest);
        if (is_below) a.leaves = face_step(from, -up, -1.0f, shortest);
        leaving_[axis] = 2 * axis + (is_above ? 1 : 0);
    }

    Axis axes_[3];
    int leaving_[3];  ///< plane of a node through which the segments leave, by axis
};

}  // namespace mir::detail
