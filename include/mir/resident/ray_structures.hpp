// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_rays.hpp"
#include "mir/accel/wide/wide_rays.hpp"

namespace mir {

/// What kernels trace single rays by: a tree that `View` reads. `M` says which points of triangles
/// are there, an Opaque or an AlphaMaskView: kernels of scenes without masks are compiled without
/// them.
template <class View, class M = Opaque>
struct RayStructure {
    using Sight = TreeVisibility<View, M>;                   ///< model of Visibility
    using Caster = FinderRayCaster<TreeRayFinder<View, M>>;  ///< model of RayCaster

    View tree;  ///< of the scene
    M mask{};   ///< of the same scene

    /// What says whether two points see each other.
    [[nodiscard]] Sight sight() const { return {tree, mask}; }
    /// What finds the first surface point along a ray; `geometry` is that of the tree.
    [[nodiscard]] Caster caster(const GeometryView<View::space>& geometry) const {
        return {geometry, tree, mask};
    }
};

/// Rays by a kd-tree, for scenes without masks.
template <Space S>
using KdRays = RayStructure<KdTreeView<S>>;

/// The same by a wide hierarchy: the same bits.
template <Space S, class M = Opaque>
using WideRays = RayStructure<WideBvhView<S>, M>;

}  // namespace mir
