// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_traverse.hpp"
#include "mir/concepts/ray_finder.hpp"

namespace mir {

/// Finds first triangles by a wide bounding volume hierarchy in memory of space `S`. Model of
/// RayFinder; the same bits on host and device. `M` as for WideBvhVisibility. What it reads must
/// outlive it. Thread-safe.
template <Space S, class M = UsualMask<S>>
struct WideRayFinder {
    static constexpr Space space = S;  ///< of the hierarchy
    using View = WideBvhView<S>;       ///< what the hierarchy is read by
    using Mask = M;                    ///< an Opaque or an AlphaMaskView

    View bvh;     ///< of the scene
    Mask mask{};  ///< which points of triangles are there

    /// The first triangle along the ray, t in metres: first_hit().
    [[nodiscard]] MIR_HD TriangleHit closest(const Ray& ray) const {
        return first_hit(bvh, ray, mask);
    }
    /// Whether a triangle hides two points from each other, metres: is_hidden().
    [[nodiscard]] MIR_HD bool hides(Vec3 from, Vec3 to) const {
        return is_hidden(bvh, from, to, mask);
    }
};

static_assert(RayFinder<WideRayFinder<Space::host>> && RayFinder<WideRayFinder<Space::device>>);

}  // namespace mir
