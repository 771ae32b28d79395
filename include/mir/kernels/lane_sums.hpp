// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/core/rgb.hpp"

namespace mir {

/// Sums in single precision in the fast memory of a group of lanes. Of as many VPLs as there are
/// lanes, in sixteen columns of luxels each. A sum that a lane changes no other may touch between
/// one LaneGroup::each() and the next.
class LaneSums {
 public:
    static constexpr std::uint32_t columns = 16;  ///< of a VPL

    /// Where the sums of a VPL, 0 to 31, begin: what column() wants. The device's memory lies in 32
    /// banks, one word of each at a time. All columns of two VPLs side by side are in different
    /// banks, and so are those of one column of all VPLs.
    [[nodiscard]] MIR_HD static std::uint32_t row(std::uint32_t vpl) {
        return columns * vpl | vpl / 2;
    }
    /// Place of a column, 0 to 15, of the VPL whose row() it is.
    [[nodiscard]] MIR_HD static std::uint32_t column(std::uint32_t row, std::uint32_t k) {
        return row ^ k;
    }

    /// The sum in a place.
    [[nodiscard]] MIR_HD Rgb operator[](std::uint32_t place) const {
        return {red_[place], green_[place], blue_[place]};
    }
    /// Replaces it.
    MIR_HD void put(std::uint32_t place, const Rgb& sum) {
        red_[place] = sum.r;
        green_[place] = sum.g;
        blue_[place] = sum.b;
    }

 private:
    static constexpr std::uint32_t places = LaneGroup::width * columns;

    float red_[places];
    float green_[places];
    float blue_[places];
};

}  // namespace mir
