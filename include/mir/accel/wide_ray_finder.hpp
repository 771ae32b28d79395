// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide_traverse.hpp"
#include "mir/concepts/ray_finder.hpp"

namespace mir {

/// Finds first triangles by a wide bounding volume hierarchy in memory of space `S`. Model of
/// RayFinder; the same bits on host and device. `M` as for WideBvhVisibility. What it reads must
/// outlive it. Thread-safe.
template <Space S, class M = UsualMask<S>>
struct WideRayFinder {
    static constexpr Space space = S;
    using View = WideBvhView<S>;
    using Mask = M;

    View bvh;
    [[no_unique_address]] Mask mask{};

    [[nodiscard]] MIR_HD TriangleHit closest(const Ray& ray) const {
        return first_hit(bvh, ray, mask);
    }
};

static_assert(RayFinder<WideRayFinder<Space::host>> && RayFinder<WideRayFinder<Space::device>>);

}  // namespace mir
