// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_traverse.hpp"
#include "mir/concepts/ray_finder.hpp"

namespace mir {

/// Finds first triangles by a kd-tree in memory of space `S`. Model of RayFinder; the same bits on
/// host and device. `M` as for KdTreeVisibility. What it reads must outlive it. Thread-safe.
template <Space S, class M = UsualMask<S>>
struct KdRayFinder {
    static constexpr Space space = S;  ///< of the tree
    using View = KdTreeView<S>;        ///< what the tree is read by
    using Mask = M;                    ///< an Opaque or an AlphaMaskView

    View tree;    ///< of the scene
    Mask mask{};  ///< which points of triangles are there

    /// The first triangle along the ray, t in metres: first_hit().
    [[nodiscard]] MIR_HD TriangleHit closest(const Ray& ray) const {
        return first_hit(tree, ray, mask);
    }
    /// Whether a triangle hides two points from each other, metres: is_hidden().
    [[nodiscard]] MIR_HD bool hides(Vec3 from, Vec3 to) const {
        return is_hidden(tree, from, to, mask);
    }
};

static_assert(RayFinder<KdRayFinder<Space::host>> && RayFinder<KdRayFinder<Space::device>>);

}  // namespace mir
