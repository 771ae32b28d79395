// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/finder_ray_caster.hpp"
#include "mir/accel/exact/tree_ray_finder.hpp"
#include "mir/accel/exact/tree_visibility.hpp"
#include "mir/accel/wide/wide_packet.hpp"
#include "mir/accel/wide/wide_traverse.hpp"

namespace mir {

/// Decides by a wide hierarchy in `S` whether two points see each other.
template <Space S, class M = UsualOpacity<S>>
using WideBvhVisibility = TreeVisibility<WideBvhView<S>, M>;

/// Finds the first triangle along a ray by such a hierarchy.
template <Space S, class M = UsualMask<S>>
using WideRayFinder = TreeRayFinder<WideBvhView<S>, M>;

/// Finds the surface that a ray sees first by such a hierarchy.
template <Space S, class M = UsualMask<S>>
using WideRayCaster = FinderRayCaster<WideRayFinder<S, M>>;

static_assert(PacketVisibility<WideBvhVisibility<Space::host>>);
static_assert(Visibility<WideBvhVisibility<Space::device>>);
static_assert(RayFinder<WideRayFinder<Space::host>> && RayFinder<WideRayFinder<Space::device>>);
static_assert(RayCaster<WideRayCaster<Space::host>>);
static_assert(PointFinder<WideRayCaster<Space::host>> && PointFinder<WideRayCaster<Space::device>>);

}  // namespace mir
