// SPDX-License-Identifier: MIT
#pragma once

#include "compare/flip_images.hpp"
#include "mir/compare/metrics.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace mirtest {

using Picture = mir::Image<mir::Rgb>;

/// Two images, what FLIP is told besides, and what its authors' program says about them.
template <class Setting>
struct FlipRow {
    std::string name;
    Picture image;
    Picture reference;
    Setting setting;
    double mean = 0.0;
    double at_60_20 = 0.0;
    double at_0_0 = 0.0;
    double at_95_63 = 0.0;
};

/// What deviation_from_table() may be.
inline constexpr double flip_tolerance = 2e-4;

/// Largest deviation from the table, over all means and all three pixels of each row, of
/// `flip(image, reference, setting)`.
template <class Setting, class Flip>
double deviation_from_table(const std::vector<FlipRow<Setting>>& table, const Flip& flip) {
    double most = 0.0;
    for (const FlipRow<Setting>& row : table) {
        const mir::Image<float> map = flip(row.image, row.reference, row.setting);
        const double here = std::max(
            {std::fabs(mir::mean_of(map) - row.mean), std::fabs(map(60, 20) - row.at_60_20),
             std::fabs(map(0, 0) - row.at_0_0), std::fabs(map(95, 63) - row.at_95_63)});
        UNSCOPED_INFO(row.name << " deviates by " << here);
        most = std::max(most, here);
    }
    return most;
}

}  // namespace mirtest
