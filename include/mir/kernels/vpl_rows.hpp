// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/data/vpl.hpp"

namespace mir {

/// VPLs, without intensities, in the fast memory of a group of lanes. There is a place for each
/// lane, with a word of the luxels that see the VPL. A place that a lane changes no other may touch
/// between one LaneGroup::each() and the next.
class VplRows {
 public:
    /// What is in a place.
    struct Row {
        Vec3 position;         ///< metres
        Vec3 normal;           ///< unit
        std::uint32_t lit;     ///< luxels that see it, a bit each
        std::uint32_t number;  ///< for the kernel to know it by
    };

    /// Puts a VPL in place `at`; `lit` and `number` are those of Row.
    MIR_HD void keep(const Vpl& vpl, std::uint32_t lit, std::uint32_t number, std::uint32_t at) {
        positions_[at] = {vpl.position.x, vpl.position.y, vpl.position.z, lit};
        normals_[at] = {vpl.normal.x, vpl.normal.y, vpl.normal.z, number};
    }
    /// Place `at`.
    [[nodiscard]] MIR_HD Row operator[](std::uint32_t at) const {
        const Quad p = positions_[at];
        const Quad n = normals_[at];
        return {{p.x, p.y, p.z}, {n.x, n.y, n.z}, p.rest, n.rest};
    }

 private:
    /// Aligned so that the device fetches it as one word.
    struct alignas(16) Quad {
        float x = 0.0f;
        float y = 0.0f;
        float z = 0.0f;
        std::uint32_t rest = 0;
    };

    Quad positions_[LaneGroup::width];
    Quad normals_[LaneGroup::width];
};

}  // namespace mir
