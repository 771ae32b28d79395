// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/finder_ray_caster.hpp"
#include "mir/accel/wide/wide_ray_finder.hpp"

namespace mir {

/// Asks a wide bounding volume hierarchy in memory of space `S` what a ray sees first.
template <Space S, class M = UsualMask<S>>
using WideRayCaster = FinderRayCaster<WideRayFinder<S, M>>;

static_assert(RayCaster<WideRayCaster<Space::host>>);
static_assert(PointFinder<WideRayCaster<Space::host>> && PointFinder<WideRayCaster<Space::device>>);

}  // namespace mir
