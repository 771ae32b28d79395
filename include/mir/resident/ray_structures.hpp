// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd_ray_caster.hpp"
#include "mir/accel/kd_tree_visibility.hpp"
#include "mir/accel/wide_bvh_visibility.hpp"
#include "mir/accel/wide_ray_caster.hpp"

namespace mir {

/// What kernels trace single rays by when it is a kd-tree; for scenes without masks.
template <Space S>
struct KdRays {
    using Sight = KdTreeVisibility<S, Opaque>;
    using Caster = KdRayCaster<S, Opaque>;

    KdTreeView<S> tree;

    [[nodiscard]] KdRayFinder<S, Opaque> finder() const { return {tree}; }
    [[nodiscard]] Sight sight() const { return {tree}; }
    [[nodiscard]] Caster caster(const GeometryView<S>& geometry) const { return {geometry, tree}; }
};

/// The same by a wide hierarchy: the same bits. `M` says which points of triangles are there, an
/// Opaque or an AlphaMaskView: kernels of scenes without masks are compiled without them.
template <Space S, class M = Opaque>
struct WideRays {
    using Sight = WideBvhVisibility<S, M>;
    using Caster = WideRayCaster<S, M>;

    WideBvhView<S> bvh;
    [[no_unique_address]] M mask{};

    [[nodiscard]] WideRayFinder<S, M> finder() const { return {bvh, mask}; }
    [[nodiscard]] Sight sight() const { return {bvh, mask}; }
    [[nodiscard]] Caster caster(const GeometryView<S>& geometry) const {
        return {geometry, bvh, mask};
    }
};

}  // namespace mir
