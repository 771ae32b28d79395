// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/core/rgb.hpp"
#include "mir/core/warp.hpp"

#include <cstdint>

namespace mir::validation::detail {

/// Random numbers of checks; `index` keeps checks apart.
inline Random numbers(std::uint64_t index) { return {20090401, Stream::test, index}; }

/// Uniform in the cube [-1, 1]^3.
inline Vec3 point_in_cube(Random& random) {
    const float x = random.next();
    const float y = random.next();
    return 2.0f * Vec3(x, y, random.next()) - 1.0f;
}

/// Uniform over directions.
inline Vec3 direction(Random& random) { return square_to_sphere(random.next_2d()); }

/// Finite and not negative.
inline bool is_radiance(Rgb c) { return is_finite(c) && c.r >= 0.0f && c.g >= 0.0f && c.b >= 0.0f; }

}  // namespace mir::validation::detail
