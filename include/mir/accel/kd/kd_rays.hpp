// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/finder_ray_caster.hpp"
#include "mir/accel/exact/tree_ray_finder.hpp"
#include "mir/accel/exact/tree_visibility.hpp"
#include "mir/accel/kd/kd_packet.hpp"
#include "mir/accel/kd/kd_traverse.hpp"

namespace mir {

/// Says by a kd-tree in memory of space `S` whether two points see each other.
template <Space S, class M = UsualOpacity<S>>
using KdTreeVisibility = TreeVisibility<KdTreeView<S>, M>;

/// Finds the first triangle along a ray by such a tree.
template <Space S, class M = UsualMask<S>>
using KdRayFinder = TreeRayFinder<KdTreeView<S>, M>;

/// Finds the surface that a ray sees first by such a tree.
template <Space S, class M = UsualMask<S>>
using KdRayCaster = FinderRayCaster<KdRayFinder<S, M>>;

static_assert(PacketVisibility<KdTreeVisibility<Space::host>>);
static_assert(Visibility<KdTreeVisibility<Space::device>>);
static_assert(RayFinder<KdRayFinder<Space::host>> && RayFinder<KdRayFinder<Space::device>>);
static_assert(RayCaster<KdRayCaster<Space::host>>);
static_assert(PointFinder<KdRayCaster<Space::host>> && PointFinder<KdRayCaster<Space::device>>);

}  // namespace mir
