// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/shaft/exact/shadow_planes.hpp"

namespace mir {

/// Planes first .. end - 1 of those that are kept.
struct PlaneRange {
    std::uint32_t first = 0;  ///< place of the first one
    std::uint32_t end = 0;    ///< behind the last one

    /// True when there is none.
    [[nodiscard]] MIR_HD bool empty() const { return first == end; }
};

/// Planes of up to 32 triangles in the memory of a group. Each is written by one lane and read by
/// all. Rows stand in arrays of their own: 32 lanes that write whole planes, 64 bytes apart, meet
/// in few banks of the device's memory and take four times as long.
class KeptPlanes {
 public:
    static constexpr std::uint32_t capacity = LaneGroup::width;  ///< planes

    /// Writes the planes of a triangle to place `at`. The triangle is known by its place in the
    /// hierarchy.
    MIR_HD void put(std::uint32_t at, const SurePlanes& planes, std::uint32_t triangle) {
        beyond_[at] = planes.beyond;
        u_[at] = planes.u;
        v_[at] = planes.v;
        w_[at] = planes.w;
        triangles_[at] = triangle;
    }
    /// The planes at place `at`.
    [[nodiscard]] MIR_HD SurePlanes get(std::uint32_t at) const {
        return {beyond_[at], u_[at], v_[at], w_[at]};
    }
    /// Whose planes those are.
    [[nodiscard]] MIR_HD std::uint32_t triangle(std::uint32_t at) const { return triangles_[at]; }

 private:
    PlainRow beyond_[capacity];
    PlainRow u_[capacity];
    PlainRow v_[capacity];
    PlainRow w_[capacity];
    std::uint32_t triangles_[capacity];
};

}  // namespace mir
