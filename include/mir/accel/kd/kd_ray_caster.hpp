// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/finder_ray_caster.hpp"
#include "mir/accel/kd/kd_ray_finder.hpp"

namespace mir {

/// Asks a kd-tree in memory of space `S` what a ray sees first.
template <Space S, class M = UsualMask<S>>
using KdRayCaster = FinderRayCaster<KdRayFinder<S, M>>;

static_assert(RayCaster<KdRayCaster<Space::host>>);
static_assert(PointFinder<KdRayCaster<Space::host>> && PointFinder<KdRayCaster<Space::device>>);

}  // namespace mir
