// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd_traverse.hpp"
#include "mir/concepts/ray_finder.hpp"

namespace mir {

/// Finds first triangles by a kd-tree in memory of space `S`. Model of RayFinder; the same bits on
/// host and device. `M` as for KdTreeVisibility. What it reads must outlive it. Thread-safe.
template <Space S, class M = UsualMask<S>>
struct KdRayFinder {
    static constexpr Space space = S;
    using View = KdTreeView<S>;
    using Mask = M;

    View tree;
    [[no_unique_address]] Mask mask{};

    [[nodiscard]] MIR_HD TriangleHit closest(const Ray& ray) const {
        return first_hit(tree, ray, mask);
    }
};

static_assert(RayFinder<KdRayFinder<Space::host>> && RayFinder<KdRayFinder<Space::device>>);

}  // namespace mir
