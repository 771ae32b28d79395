// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/triangle_rows.hpp"
#include "mir/core/lanes.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace mir {

namespace detail {

/// An affine function per lane.
struct LaneRows {
    LaneFloats x;
    LaneFloats y;
    LaneFloats z;
    LaneFloats w;

    [[nodiscard]] AffineRow row(std::uint32_t k) const {
        return {x.at[k], y.at[k], z.at[k], w.at[k]};
    }
    void set(std::uint32_t k, AffineRow r) {
        x.at[k] = r.x;
        y.at[k] = r.y;
        z.at[k] = r.z;
        w.at[k] = r.w;
    }
};

}  // namespace detail

/// Sixteen triangles side by side, as vector units read them. Those at the places 16 i to 16 i + 15
/// of a hierarchy, whose leaves next to each other share them.
struct TriangleLanes {
    detail::LaneRows u;  ///< as TriangleRows::u, of each
    detail::LaneRows v;  ///< as TriangleRows::v
    detail::LaneRows s;  ///< as TriangleRows::s, metres

    /// Rows of the triangle in lane `k` < 16, bit for bit.
    [[nodiscard]] TriangleRows rows(std::uint32_t k) const {
        return {u.row(k), v.row(k), s.row(k)};
    }
};

/// The triangles of a hierarchy once more, in lanes. The last ones are filled up with triangles
/// that no segment crosses.
[[nodiscard]] inline std::vector<TriangleLanes> make_triangle_lanes(
    std::span<const TriangleRows> triangles) {
    constexpr std::size_t width = detail::lane_count;
    std::vector<TriangleLanes> groups((triangles.size() + width - 1) / width);
    for (std::size_t i = 0; i < groups.size() * width; ++i) {
        const TriangleRows rows = i < triangles.size() ? triangles[i] : uncrossable_rows();
        TriangleLanes& group = groups[i / width];
        const auto k = static_cast<std::uint32_t>(i % width);
        group.u.set(k, rows.u);
        group.v.set(k, rows.v);
        group.s.set(k, rows.s);
    }
    return groups;
}

}  // namespace mir
