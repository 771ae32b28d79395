// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/kd_fragment.hpp"
#include "mir/accel/kd/kd_options.hpp"

#include <cmath>
#include <span>

namespace mir::detail {

/// What a plane parts from what.
enum class KdCutKind {
    none,         ///< a leaf is better
    parts,        ///< fragments on both sides
    empty_below,  ///< all fragments above
    empty_above   ///< all fragments below
};

/// A plane and its cost (surface area heuristic), in units of a triangle test.
struct KdSplit {
    KdCutKind kind = KdCutKind::none;
    int axis = 0;
    float at = 0.0f;
    float cost = 0.0f;
};

/// Surface area heuristic in one cell (MacDonald and Booth 1990). A plane with N_l triangles below
/// and N_r above costs N_l A_l / A + N_r A_r / A. Areas are affine in the plane's place, and are
/// computed relative to the cell's widest extent, so nothing overflows at any scale.
struct KdCost {
    KdCost(const KdCell& c, std::size_t triangles, const KdTreeOptions& options)
        : cell(c),
          count(static_cast<float>(triangles)),
          bonus(1.0f - options.empty_bonus),
          limit(count - options.visit_cost()) {
        const Float4 extent = c.high - c.low;
        const float widest = std::max(extent[0], std::max(extent[1], extent[2]));
        const Float4 w = extent * all_lanes(1.0f / widest);
        const Float4 sides = w * next_axes(w);
        const float area = sides[0] + sides[1] + sides[2];
        const float inverse = 1.0f / area;
        base = next_axes(sides) * all_lanes(inverse);
        slope = (next_axes(w) + last_axes(w)) * all_lanes(inverse / widest);
        usable = widest > 0.0f && std::isfinite(inverse / widest);
    }

    /// Of planes at `at` on each axis. A plane at the low end leaves all of the area above.
    [[nodiscard]] Float4 operator()(Float4 at, Float4 below, Float4 above) const {
        return below * base + above + slope * (at - cell.low) * (below - above);
    }
    [[nodiscard]] float operator()(int axis, float at, float below, float above) const {
        return below * base[axis] + above + slope[axis] * (at - cell.low[axis]) * (below - above);
    }

    KdCell cell;
    float count = 0.0f;
    float bonus = 1.0f;
    float limit = 0.0f;  ///< a plane has to cost less, or a leaf is better
    bool usable = false;
    Float4 base = {0, 0, 0, 0};
    Float4 slope = {0, 0, 0, 0};
};

/// The best planes on the three axes.
struct KdCandidates {
    Float4 cost;
    Float4 at = {0, 0, 0, 0};
    Int4 kind = Int4{} + static_cast<int>(KdCutKind::parts);

    void keep_cheaper(Float4 other_cost, Float4 other_at, KdCutKind other_kind) {
        const Int4 cheaper = other_cost < cost;
        cost = cheaper ? other_cost : cost;
        at = cheaper ? other_at : at;
        kind = cheaper ? Int4{} + static_cast<int>(other_kind) : kind;
    }

    /// Planes at both ends of what the cell contains: one side is empty.
    void try_empty_sides(const KdCost& of, Float4 content_low, Float4 content_high) {
        const Float4 none = all_lanes(std::numeric_limits<float>::infinity());
        const Float4 zero = all_lanes(0.0f);
        const Float4 all = all_lanes(of.count);
        const Float4 bonus = all_lanes(of.bonus);
        const Float4 below = of(content_low, zero, all) * bonus;
        const Float4 above = of(content_high, all, zero) * bonus;
        keep_cheaper(content_low > of.cell.low ? below : none, content_low, KdCutKind::empty_below);
        keep_cheaper(content_high < of.cell.high ? above : none, content_high,
                     KdCutKind::empty_above);
    }

    /// The cheapest, on the lowest axis, if it costs less than `limit`.
    [[nodiscard]] KdSplit best(float limit) const {
        KdSplit best{KdCutKind::none, 0, 0.0f, limit};
        for (int axis = 0; axis < 3; ++axis)
            if (cost[axis] < best.cost)
                best = {static_cast<KdCutKind>(kind[axis]), axis, at[axis], cost[axis]};
        return best;
    }
};

/// No plane when the best one lies outside of the cell, by rounding.
inline KdSplit only_inside(const KdSplit& split, const KdCell& cell) {
    const bool inside = split.at > cell.low[split.axis] && split.at < cell.high[split.axis];
    return inside ? split : KdSplit{};
}

}  // namespace mir::detail
