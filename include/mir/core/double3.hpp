// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/strict_float.hpp"

namespace mir::detail {

using Double3 = glm::dvec3;

/// Sum of the absolute values.
MIR_HD inline double l1_norm(Double3 v) {
    return strict::add(strict::add(fabs(v.x), fabs(v.y)), fabs(v.z));
}

/// The smaller and the larger number of each axis, of equal ones that of `a`.
MIR_HD inline Double3 smaller_axes(Double3 a, Double3 b) {
    return {b.x < a.x ? b.x : a.x, b.y < a.y ? b.y : a.y, b.z < a.z ? b.z : a.z};
}
MIR_HD inline Double3 larger_axes(Double3 a, Double3 b) {
    return {a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y, a.z < b.z ? b.z : a.z};
}

}  // namespace mir::detail

namespace mir::strict {

// The operations of strict_float.hpp on three numbers, in the order in which GLM does them.

/// a + b, axis by axis.
MIR_HD inline detail::Double3 add(detail::Double3 a, detail::Double3 b) {
    return {add(a.x, b.x), add(a.y, b.y), add(a.z, b.z)};
}
/// a - b, axis by axis.
MIR_HD inline detail::Double3 sub(detail::Double3 a, detail::Double3 b) {
    return {sub(a.x, b.x), sub(a.y, b.y), sub(a.z, b.z)};
}
/// s v.
MIR_HD inline detail::Double3 mul(double s, detail::Double3 v) {
    return {mul(s, v.x), mul(s, v.y), mul(s, v.z)};
}
/// v / s, three divisions.
MIR_HD inline detail::Double3 div(detail::Double3 v, double s) {
    return {div(v.x, s), div(v.y, s), div(v.z, s)};
}
/// The inner product, summed from x to z.
MIR_HD inline double dot(detail::Double3 a, detail::Double3 b) {
    return add(add(mul(a.x, b.x), mul(a.y, b.y)), mul(a.z, b.z));
}
/// The vector product a x b.
MIR_HD inline detail::Double3 cross(detail::Double3 a, detail::Double3 b) {
    return {sub(mul(a.y, b.z), mul(b.y, a.z)), sub(mul(a.z, b.x), mul(b.z, a.x)),
            sub(mul(a.x, b.y), mul(b.x, a.y))};
}

}  // namespace mir::strict
