// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace mirtool {

/// Points of a LogChart that belong together, joined by a line.
struct LogSeries {
    struct Point {
        double x = 0.0;
        double y = 0.0;
    };
    std::string name;
    std::vector<Point> points;  ///< by x; those that are not positive and finite are left out
};

/// Series over two logarithmic axes, and a line of slope -1/2. It runs through the last point of
/// the first series and is the fall of the error of independent samples.
struct LogChart {
    std::string title;              ///< for those who do not see it too
    std::string x_label, y_label;   ///< quantity and unit
    std::vector<LogSeries> series;  ///< at most two
};

/// The chart as an SVG element with its legend. Empty unless a series has two points.
std::string log_chart(const LogChart& chart);

}  // namespace mirtool
