// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide_traverse.hpp"
#include "mir/concepts/ray_finder.hpp"

namespace mir {

/// Finds first triangles by a wide bounding volume hierarchy in memory of space `S`. Model of
/// RayFinder; the same bits on host and device. The hierarchy must outlive it. Thread-safe.
template <Space S>
struct WideRayFinder {
    static constexpr Space space = S;
    using View = WideBvhView<S>;

    View bvh;

    [[nodiscard]] MIR_HD TriangleHit closest(const Ray& ray) const { return first_hit(bvh, ray); }
};

static_assert(RayFinder<WideRayFinder<Space::host>> && RayFinder<WideRayFinder<Space::device>>);

}  // namespace mir
