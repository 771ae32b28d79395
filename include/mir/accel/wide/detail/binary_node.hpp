// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/strict_float.hpp"

#include <cstdint>

namespace mir::detail {

/// A node of the binary tree that is made into a wide one. Its leaves are single triangles or parts
/// of such.
struct BinaryNode {
    Vec3 low{0};
    Vec3 high{0};
    std::uint32_t left = 0;   ///< child, or the triangle of a leaf
    std::uint32_t right = 0;  ///< child; nothing in a leaf
    std::uint32_t count = 0;  ///< leaves below; 1 in a leaf
    /// Most nodes down to what fits into a leaf of the wide tree. 0 when all of it does.
    std::uint32_t height = 0;
};

/// Half the surface of a box, with lengths multiplied by `scale` so that nothing overflows. The
/// same bits on host and device, as trees depend on it.
MIR_HD inline float half_area(Vec3 low, Vec3 high, float scale) {
    const float x = strict::mul(strict::sub(high.x, low.x), scale);
    const float y = strict::mul(strict::sub(high.y, low.y), scale);
    const float z = strict::mul(strict::sub(high.z, low.z), scale);
    return strict::add(strict::add(strict::mul(x, y), strict::mul(y, z)), strict::mul(z, x));
}

MIR_HD inline Vec3 lower_corner(Vec3 a, Vec3 b) {
    return {smaller(a.x, b.x), smaller(a.y, b.y), smaller(a.z, b.z)};
}
MIR_HD inline Vec3 upper_corner(Vec3 a, Vec3 b) {
    return {larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z)};
}

}  // namespace mir::detail
