// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/triangle_rows.hpp"

#include <limits>

namespace mir {

/// A triangle as the segments of one pyramid are tested against it: affine functions of the
/// segments' ends, given by their difference from the centre of the pyramid's base. Source and
/// names: occlusion.hpp. Aligned so that the device moves it in four words.
struct alignas(16) SegmentForms {
    AffineRow beyond;  ///< s': distance beyond the plane as seen from the apex, metres
    AffineRow u;       ///< U and V, metres
    AffineRow v;
    float depth = 0.0f;  ///< S: distance of the apex from the plane, metres
    float margin = std::numeric_limits<float>::infinity();  ///< of U, V and W, metres
    std::uint32_t triangle = 0;
    std::uint32_t unused = 0;  ///< so that the fourth word is written whole
};

namespace detail {

/// For bounds, which have margins for rounding.
MIR_HD inline float loose_dot(Vec3 a, Vec3 b) {
    return loose::mul_add(a.z, b.z, loose::mul_add(a.y, b.y, strict::mul(a.x, b.x)));
}

/// Value of a row at a point, likewise: no worse than row_at().
MIR_HD inline float loose_at(AffineRow row, Vec3 p) {
    return strict::add(loose_dot({row.x, row.y, row.z}, p), row.w);
}

/// Where an affine function keeps its sign: never above -margin, never below margin.
struct SureSign {
    bool negative = false;
    bool positive = false;
};

}  // namespace detail

/// Whether hits_segment() accepts (positive) or refuses (negative) the segment to the point that
/// lies at `end` from the centre of the base; neither where rounding might decide. `plane` is the
/// margin of s', metres. What is no number shows nothing. docs/shafts.md derives the margins.
[[nodiscard]] MIR_HD inline detail::SureSign sure_hit(const SegmentForms& f, Vec3 end,
                                                      float plane) {
    const float beyond = detail::loose_at(f.beyond, end);
    const float u = detail::loose_at(f.u, end);
    const float v = detail::loose_at(f.v, end);
    const float w = strict::sub(strict::sub(strict::add(beyond, f.depth), u), v);
    return {beyond < -plane || u < -f.margin || v < -f.margin ||
            w<-f.margin, beyond> plane && u > f.margin && v > f.margin && w > f.margin};
}

}  // namespace mir
