// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_rays.hpp"
#include "mir/accel/wide/wide_rays.hpp"

namespace mir {

/// What kernels trace single rays by: a tree that `View` reads. `M` says which triangles stop what,
/// an Opaque or an OpacityView: kernels of opaque scenes are compiled without it.
template <class View, class M = Opaque>
struct RayStructure {
    using Sight = TreeVisibility<View, M>;  ///< model of Visibility
    /// Model of RayCaster.
    using Caster = FinderRayCaster<TreeRayFinder<View, typename M::Masks>>;

    View tree;    ///< of the scene
    M opacity{};  ///< of the same scene

    /// What says whether two points see each other.
    [[nodiscard]] Sight sight() const { return {tree, opacity}; }
    /// What finds the first surface point along a ray; `geometry` is that of the tree.
    [[nodiscard]] Caster caster(const GeometryView<View::space>& geometry) const {
        return {geometry, tree, opacity.masks()};
    }
};

/// Rays by a kd-tree, for opaque scenes.
template <Space S>
using KdRays = RayStructure<KdTreeView<S>>;

/// The same by a wide hierarchy: the same bits.
template <Space S, class M = Opaque>
using WideRays = RayStructure<WideBvhView<S>, M>;

}  // namespace mir
