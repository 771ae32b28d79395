// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_node.hpp"
#include "mir/core/lanes.hpp"
#include "mir/shaft/exact/shaft.hpp"

#include <limits>

namespace mir {

/// A shaft as the eight children of a node are tested against it at once. What meets_box() decides
/// by the signs of rates is decided here, once for the whole walk. On the host.
class SlotShaft {
 public:
    /// Of a shaft, which need not outlive it.
    explicit SlotShaft(const Shaft& shaft) : shaft_(shaft) {
        for (int axis = 0; axis < 3; ++axis) {
            const bool leaves_high = shaft.leaves[axis] > 0.0f;
            leaving_[axis] = 2 * axis + (leaves_high ? 1 : 0);
            never_[axis] = shaft.leaves[axis] == 0.0f ? 1.0f : 0.0f;
        }
        foremost_[0] = shaft.front.x > 0.0f ? 1 : 0;
        foremost_[1] = shaft.front.y > 0.0f ? 3 : 2;
        foremost_[2] = shaft.front.z > 0.0f ? 5 : 4;
    }

    /// Bit k where meets_box() is true of the box of child k. The operations are the same; what it
    /// says of empty slots means nothing.
    template <InstructionSet Set = InstructionSet::baseline>
    [[nodiscard]] std::uint32_t met(const WideNode& node) const {
        const auto& planes = node.planes;
        const ChildRow& leave_x = planes[leaving_[0]];
        const ChildRow& leave_y = planes[leaving_[1]];
        const ChildRow& leave_z = planes[leaving_[2]];
        const ChildRow& front_x = planes[foremost_[0]];
        const ChildRow& front_y = planes[foremost_[1]];
        const ChildRow& front_z = planes[foremost_[2]];
        const Shaft s = shaft_;
        const Vec3 never(never_[0], never_[1], never_[2]);
        detail::SlotTruths truths;
        for (std::uint32_t k = 0; k < WideNode::width; ++k) {
            float near = 0.0f;
            near = larger(near, strict::mul(planes[0][k] - s.apex.x, s.rises.x));
            near = larger(near, strict::mul(planes[1][k] - s.apex.x, s.falls.x));
            near = larger(near, strict::mul(planes[2][k] - s.apex.y, s.rises.y));
            near = larger(near, strict::mul(planes[3][k] - s.apex.y, s.falls.y));
            near = larger(near, strict::mul(planes[4][k] - s.apex.z, s.rises.z));
            near = larger(near, strict::mul(planes[5][k] - s.apex.z, s.falls.z));
            // Where the VPL lies beside no face the rate is zero and the bound becomes 1.
            float far = 1.0f;
            far = smaller(far, strict::mul(leave_x[k] - s.apex.x, s.leaves.x) + never.x);
            far = smaller(far, strict::mul(leave_y[k] - s.apex.y, s.leaves.y) + never.y);
            far = smaller(far, strict::mul(leave_z[k] - s.apex.z, s.leaves.z) + never.z);
            const float end =
                strict::add(strict::mul(FloatPlaneSlack::relative, far), FloatPlaneSlack::absolute);
            const float front = row_at(s.front, {front_x[k], front_y[k], front_z[k]});
            const int met = static_cast<int>(near <= end) & static_cast<int>(front >= 0.0f);
            truths.at[k] = -met;
        }
        return detail::bits_of<Set>(truths);
    }

 private:
    Shaft shaft_;
    int leaving_[3];   ///< plane of a node through which the shaft leaves, by axis
    float never_[3];   ///< 1 where it leaves through none
    int foremost_[3];  ///< plane of a node that lies foremost in the half-space, by axis
};

namespace detail {

/// Children of a node that are leaves.
template <InstructionSet Set>
std::uint32_t leaf_slots(const WideNode& node) {
    SlotTruths truths;
    for (std::uint32_t k = 0; k < WideNode::width; ++k) truths.at[k] = node.count[k] > 0 ? -1 : 0;
    return bits_of<Set>(truths);
}

/// Children of a node that are nodes.
template <InstructionSet Set>
std::uint32_t inner_slots(const WideNode& node) {
    SlotTruths truths;
    for (std::uint32_t k = 0; k < WideNode::width; ++k)
        truths.at[k] = node.count[k] == WideNode::inner ? -1 : 0;
    return bits_of<Set>(truths);
}

}  // namespace detail
}  // namespace mir
