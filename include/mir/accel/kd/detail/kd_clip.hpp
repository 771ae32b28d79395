// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/kd_fragment.hpp"

namespace mir::detail {

/// A convex polygon: a triangle cut by up to six planes.
struct KdPolygon {
    alignas(16) float corner[10][4];
    int count = 0;
};

/// Corners of `from` cut to where sign (x - at) >= 0. Crossings and corners are always stored and
/// counted only where they belong: no branch depends on them.
inline void cut_polygon(const KdPolygon& from, KdPolygon& to, int axis, float at, float sign) {
    int n = 0;
    Float4 before = load_lanes(from.corner[from.count - 1]);
    float distance_before = sign * (from.corner[from.count - 1][axis] - at);
    for (int i = 0; i < from.count; ++i) {
        const Float4 here = load_lanes(from.corner[i]);
        const float distance = sign * (from.corner[i][axis] - at);
        const bool inside = distance >= 0.0f;
        const float t = distance_before / (distance_before - distance);
        store_lanes(before + (here - before) * all_lanes(t), to.corner[n]);
        n += inside != (distance_before >= 0.0f) ? 1 : 0;
        store_lanes(here, to.corner[n]);
        n += inside ? 1 : 0;
        before = here;
        distance_before = distance;
    }
    to.count = n;
}

/// Cuts a triangle to the faces of a cell that its fragment touches. The others are implied. The
/// result is in one of two polygons.
inline const KdPolygon& cut_to_cell(const ClipTriangle& triangle, const KdFragment& fragment,
                                    const KdCell& cell, KdPolygon (&polygons)[2]) {
    const Float4 a = load_lanes(&triangle.a.x);
    const Float4 b = load_lanes(&triangle.b.x);
    const Float4 c = load_lanes(&triangle.c.x);
    int now = 0;
    store_lanes(a, polygons[0].corner[0]);
    store_lanes(b, polygons[0].corner[1]);
    store_lanes(c, polygons[0].corner[2]);
    polygons[0].count = 3;
    const Float4 low = cell.low - triangle.grow();
    const Float4 high = cell.high + triangle.grow();
    const Int4 below =
        (smaller_lanes(a, smaller_lanes(b, c)) < low) & (fragment.low_lanes() <= cell.low);
    const Int4 above =
        (larger_lanes(a, larger_lanes(b, c)) > high) & (fragment.high_lanes() >= cell.high);
    for (int axis = 0; axis < 3; ++axis) {
        if (below[axis] != 0 && polygons[now].count > 0) {
            cut_polygon(polygons[now], polygons[1 - now], axis, low[axis], 1.0f);
            now = 1 - now;
        }
        if (above[axis] != 0 && polygons[now].count > 0) {
            cut_polygon(polygons[now], polygons[1 - now], axis, high[axis], -1.0f);
            now = 1 - now;
        }
    }
    return polygons[now];
}

/// Box under construction.
struct KdExtent {
    Float4 low = all_lanes(std::numeric_limits<float>::infinity());
    Float4 high = all_lanes(-std::numeric_limits<float>::infinity());

    /// Where `mask` is set.
    void add(Float4 p, Int4 mask) {
        const Float4 infinity = all_lanes(std::numeric_limits<float>::infinity());
        low = smaller_lanes(mask ? p : infinity, low);
        high = larger_lanes(mask ? p : -infinity, high);
    }
};

/// Boxes of the two parts of a polygon. Where x <= low_side and where x >= high_side.
inline void extents_of_parts(const KdPolygon& polygon, int axis, float low_side, float high_side,
                             KdExtent& left, KdExtent& right) {
    if (polygon.count == 0) return;
    const Float4 left_end = all_lanes(low_side);
    const Float4 right_end = all_lanes(high_side);
    Float4 before = load_lanes(polygon.corner[polygon.count - 1]);
    Float4 x_before = all_lanes(polygon.corner[polygon.count - 1][axis]);
    Int4 left_before = x_before <= left_end;
    Int4 right_before = x_before >= right_end;
    for (int i = 0; i < polygon.count; ++i) {
        const Float4 here = load_lanes(polygon.corner[i]);
        const Float4 x = all_lanes(polygon.corner[i][axis]);
        const Float4 step = here - before;
        const Float4 run = x - x_before;
        const Int4 left_here = x <= left_end;
        const Int4 right_here = x >= right_end;
        left.add(here, left_here);
        right.add(here, right_here);
        left.add(before + step * ((left_end - x_before) / run), left_here ^ left_before);
        right.add(before + step * ((right_end - x_before) / run), right_here ^ right_before);
        before = here;
        x_before = x;
        left_before = left_here;
        right_before = right_here;
    }
}

/// The box `extent` grown and cut to `within`. Returns whether anything is left.
inline bool keep_part(KdFragment& part, const KdExtent& extent, Float4 grow, Float4 low,
                      Float4 high) {
    const Float4 part_low = larger_lanes(even_lanes(axes_only(extent.low - grow)), low);
    const Float4 part_high = smaller_lanes(even_lanes(axes_only(extent.high + grow)), high);
    part.set_box(part_low, part_high);
    const Int4 some = part_low < part_high;
    return (some[0] & some[1] & some[2]) != 0;
}

/// What a plane makes of a fragment that lies on both of its sides.
struct KdParts {
    KdFragment below;
    KdFragment above;
    bool has_below = false;
    bool has_above = false;
};

inline KdParts split_fragment(const KdFragment& fragment, const ClipTriangle& triangle,
                              const KdCell& cell, int axis, float at) {
    KdParts parts{fragment, fragment, true, true};
    const Float4 low = axes_only(fragment.low_lanes());
    const Float4 high = axes_only(fragment.high_lanes());
    Float4 below_high = high;
    Float4 above_low = low;
    below_high[axis] = at;
    above_low[axis] = at;
    if (triangle.is_wild()) {
        parts.below.set_box(low, below_high);
        parts.above.set_box(above_low, high);
        return parts;
    }
    KdPolygon polygons[2];
    const KdPolygon& polygon = cut_to_cell(triangle, fragment, cell, polygons);
    const Float4 grow = triangle.grow();
    KdExtent left;
    KdExtent right;
    extents_of_parts(polygon, axis, at + grow[axis], at - grow[axis], left, right);
    parts.has_below = keep_part(parts.below, left, grow, low, below_high);
    parts.has_above = keep_part(parts.above, right, grow, above_low, high);
    return parts;
}

}  // namespace mir::detail
