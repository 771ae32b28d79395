// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/bounds.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace mir::detail {

/// Largest absolute component. Same unit as `v`.
inline double largest_coordinate(DVec3 v) {
    return std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
}

/// Axis-aligned box in double precision. Empty until a point is added.
struct FarBox {
    DVec3 low{std::numeric_limits<double>::infinity()};
    DVec3 high{-std::numeric_limits<double>::infinity()};

    void add(DVec3 p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    /// Grows to hold `box`, placed by an affine transform.
    void add(const FarBox& box, const DMat4& to_world) {
        for (int corner = 0; corner < 8; ++corner) {
            const DVec3 p((corner & 1) != 0 ? box.high.x : box.low.x,
                          (corner & 2) != 0 ? box.high.y : box.low.y,
                          (corner & 4) != 0 ? box.high.z : box.low.z);
            add(DVec3(to_world * glm::dvec4(p, 1.0)));
        }
    }
    /// Neither empty nor infinite.
    [[nodiscard]] bool is_usable() const { return low.x <= high.x && std::isfinite(reach()); }
    [[nodiscard]] DVec3 centre() const { return 0.5 * low + 0.5 * high; }
    /// Longest edge; metres, as the coordinates.
    [[nodiscard]] double size() const { return largest_coordinate(high - low); }
    /// Largest absolute coordinate of a point in it.
    [[nodiscard]] double reach() const {
        return std::fmax(largest_coordinate(low), largest_coordinate(high));
    }
};

inline FarBox box_of(const std::vector<Vec3>& points) {
    Bounds bounds;
    for (const Vec3 p : points) bounds.add(p);
    return {DVec3(bounds.low), DVec3(bounds.high)};
}

/// Sizes of a box that may lie between it and the origin. They cost three of the 24 bits of a
/// float, and what was not made to lie far away keeps its coordinates.
inline constexpr double near_sizes = 8.0;

/// What to subtract from one coordinate of all points of a box. The box has such a size around
/// `centre`. It is 0 for a box that is near, else a multiple of a power of two so large that
/// differences are exact in double precision and, of floats, in single precision, and so small that
/// the box ends up near.
inline double shift_along(double centre, double size) {
    if (std::fabs(centre) <= near_sizes * size) return 0.0;
    // Six sizes: lengths that people choose, 1, 2, 2.5, 4 or 5, lie away from where the power
    // changes, so that rounding of the box does not decide.
    const double step = std::fmax(6.0 * size, std::fabs(centre) * 0x1p-40);
    const double power = std::scalbn(1.0, std::ilogb(step));
    return std::round(centre / power) * power;
}

/// shift_along() for each coordinate of a box; zero where the box cannot be used.
inline DVec3 shift_of(const FarBox& box) {
    if (!box.is_usable()) return DVec3(0.0);
    const DVec3 c = box.centre();
    const double size = box.size();
    return {shift_along(c.x, size), shift_along(c.y, size), shift_along(c.z, size)};
}

}  // namespace mir::detail
