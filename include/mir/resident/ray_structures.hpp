// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd_ray_caster.hpp"
#include "mir/accel/kd_tree_visibility.hpp"
#include "mir/accel/wide_bvh_visibility.hpp"
#include "mir/accel/wide_ray_caster.hpp"

namespace mir {

/// What kernels trace single rays by when it is a kd-tree.
template <Space S>
struct KdRays {
    using Sight = KdTreeVisibility<S>;
    using Caster = KdRayCaster<S>;

    KdTreeView<S> tree;

    [[nodiscard]] KdRayFinder<S> finder() const { return {tree}; }
    [[nodiscard]] Sight sight() const { return {tree}; }
    [[nodiscard]] Caster caster(const GeometryView<S>& geometry) const { return {geometry, tree}; }
};

/// The same by a wide hierarchy: the same bits.
template <Space S>
struct WideRays {
    using Sight = WideBvhVisibility<S>;
    using Caster = WideRayCaster<S>;

    WideBvhView<S> bvh;

    [[nodiscard]] WideRayFinder<S> finder() const { return {bvh}; }
    [[nodiscard]] Sight sight() const { return {bvh}; }
    [[nodiscard]] Caster caster(const GeometryView<S>& geometry) const { return {geometry, bvh}; }
};

}  // namespace mir
