// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_ray_caster.hpp"
#include "mir/accel/kd/kd_tree_visibility.hpp"
#include "mir/accel/wide/wide_bvh_visibility.hpp"
#include "mir/accel/wide/wide_ray_caster.hpp"

namespace mir {

/// What kernels trace single rays by when it is a kd-tree; for scenes without masks.
template <Space S>
struct KdRays {
    using Sight = KdTreeVisibility<S, Opaque>;  ///< model of Visibility
    using Caster = KdRayCaster<S, Opaque>;      ///< model of RayCaster

    KdTreeView<S> tree;  ///< of the scene

    /// What says whether two points see each other.
    [[nodiscard]] Sight sight() const { return {tree}; }
    /// What finds the first surface point along a ray; `geometry` is that of the tree.
    [[nodiscard]] Caster caster(const GeometryView<S>& geometry) const { return {geometry, tree}; }
};

/// The same by a wide hierarchy: the same bits. `M` says which points of triangles are there, an
/// Opaque or an AlphaMaskView: kernels of scenes without masks are compiled without them.
template <Space S, class M = Opaque>
struct WideRays {
    using Sight = WideBvhVisibility<S, M>;  ///< model of Visibility
    using Caster = WideRayCaster<S, M>;     ///< model of RayCaster

    WideBvhView<S> bvh;  ///< of the scene
    M mask{};            ///< of the same scene

    /// What says whether two points see each other.
    [[nodiscard]] Sight sight() const { return {bvh, mask}; }
    /// What finds the first surface point along a ray; `geometry` is that of the hierarchy.
    [[nodiscard]] Caster caster(const GeometryView<S>& geometry) const {
        return {geometry, bvh, mask};
    }
};

}  // namespace mir
