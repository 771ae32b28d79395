// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/strict_float.hpp"

namespace mir {

/// An affine function of a point p in metres. Its value is x p.x + y p.y + z p.z + w. Aligned so
/// that the device fetches it as one word.
struct alignas(16) AffineRow {
    float x = 0.0f;  ///< factor of p.x, the value's unit per metre
    float y = 0.0f;  ///< of p.y
    float z = 0.0f;  ///< of p.z
    float w = 0.0f;  ///< value at the origin
};

/// A triangle in the form in which segments are tested. Three affine functions of a point.
/// u and v are the barycentric coordinates of the second and third corner along the normal,
/// s is the signed distance from the plane in metres, positive in front. Source: Baldwin
/// and Weber, "Fast ray-triangle intersections by coordinate transformation", JCGT 5(3),
/// 2016.
struct TriangleRows {
    AffineRow u;  ///< weight of the second corner
    AffineRow v;  ///< weight of the third corner
    AffineRow s;  ///< distance from the plane, metres
};

/// Value of an affine row at a point. All tests share this one order of operations.
[[nodiscard]] MIR_HD inline float row_at(AffineRow row, Vec3 p) {
    const float xy = strict::add(strict::mul(row.x, p.x), strict::mul(row.y, p.y));
    return strict::add(strict::add(xy, strict::mul(row.z, p.z)), row.w);
}

namespace detail {

/// Sum of the absolute components of a row's gradient, the value's unit per metre.
MIR_HD inline float l1_of_gradient(AffineRow row) {
    return strict::add(strict::add(fabsf(row.x), fabsf(row.y)), fabsf(row.z));
}

}  // namespace detail

}  // namespace mir
