// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/accept_box.hpp"
#include "mir/accel/kd/detail/lanes.hpp"

#include <cstdint>
#include <limits>

namespace mir::detail {

/// The part of a triangle's accept region that lies in a cell, as a box. The last bit of every
/// coordinate is zero: sorting keys use it.
struct alignas(16) KdFragment {
    float low[3];
    std::uint32_t triangle;
    float high[3];
    std::uint32_t spare;

    [[nodiscard]] Float4 low_lanes() const { return load_lanes(low); }
    [[nodiscard]] Float4 high_lanes() const { return load_lanes(high); }

    /// All of it: the triangle lies in the spare lane.
    void set_lanes(Float4 new_low, Float4 new_high) {
        store_lanes(new_low, low);
        store_lanes(new_high, high);
    }

    /// Keeps the triangle. Written in one piece, as it will be read.
    void set_box(Float4 new_low, Float4 new_high) {
        Int4 bits = bits_of(new_low);
        bits[3] = static_cast<std::int32_t>(triangle);
        set_lanes(floats_of(bits), new_high);
    }
};
static_assert(sizeof(KdFragment) == 32);

/// Box of a node, metres; spare lanes zero.
struct KdCell {
    Float4 low = {0, 0, 0, 0};
    Float4 high = {0, 0, 0, 0};
};

/// A triangle as clipping needs it. The corners of its accept triangle, and in the fourth
/// components, by axis, the distance that boxes around its parts have to grow.
struct alignas(16) ClipTriangle {
    Vec4 a;
    Vec4 b;
    Vec4 c;

    [[nodiscard]] Float4 grow() const { return Float4{a.w, b.w, c.w, 0.0f}; }
    /// Reaches so far that single precision clips it badly: boxes are cut instead.
    [[nodiscard]] bool is_wild() const { return a.w == std::numeric_limits<float>::infinity(); }
};

/// A triangle together with the box of its whole accept region.
struct KdItem {
    ClipTriangle triangle;
    KdFragment fragment;
};

// What boxes grow by, e = 2^-24, M the magnitude: the accept margin, 64 e M, in whose range
// accepted points lie around the accept triangle; 24 e M for rounding corners (1.5), planes (1.5),
// crossings (7 times 1.5), the sum (1.5) and the cleared last bit (3); and 40 e times the
// triangle's extent on the axis for the 7 crossings, 5 e each. Clipping cells grow by the same, so
// that clipping rounded polygons loses nothing: (P + d) n H lies in (P n (H + d)) + d.
inline Double3 clip_margin(Double3 extent, float magnitude) {
    const double eps = 0x1p-24;
    return 88.0 * eps * static_cast<double>(magnitude) + 40.0 * eps * extent;
}

inline KdItem make_item(Vec3 a, Vec3 b, Vec3 c, std::uint32_t index, float magnitude) {
    const AcceptTriangle t = accept_triangle(a, b, c, magnitude);
    const Double3 reach(static_cast<double>(reach_of(magnitude)));
    const Double3 most = reach + accept_margin_of(magnitude);
    const Double3 low = glm::min(t.a, glm::min(t.b, t.c));
    const Double3 high = glm::max(t.a, glm::max(t.b, t.c));
    const bool wild = glm::any(glm::lessThan(low, -reach)) || glm::any(glm::lessThan(reach, high));
    const Double3 near = glm::max(low, -reach);
    const Double3 far = glm::min(high, reach);
    const Double3 grow = clip_margin(far - near, magnitude);
    const Vec3 box_low(glm::max(near - grow, -most));
    const Vec3 box_high(glm::min(far + grow, most));
    const Vec3 w = wild ? Vec3(std::numeric_limits<float>::infinity()) : Vec3(grow);
    KdItem item;
    if (wild)
        item.triangle = {Vec4(w.x), Vec4(w.y), Vec4(w.z)};
    else
        item.triangle = {{Vec3(t.a), w.x}, {Vec3(t.b), w.y}, {Vec3(t.c), w.z}};
    item.fragment.triangle = index;
    item.fragment.set_box(even_lanes(lanes_of(box_low)), even_lanes(lanes_of(box_high)));
    return item;
}

}  // namespace mir::detail
