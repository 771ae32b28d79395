// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/morton.hpp"
#include "mir/paths/path_world.hpp"

namespace mir {

/// Place of a path's VPL, x2, on a space-filling curve, below 2^30. Paths in the order of their
/// places are spread evenly by systematic resampling.
template <class World>
MIR_HD std::uint64_t place_of_vpl(const World& world, const Path& path) {
    const Vec3 corner = world.lights.sphere.centre - world.lights.sphere.radius;
    return morton_code((path.x(2).position - corner) / (2.0f * world.lights.sphere.radius));
}

}  // namespace mir
