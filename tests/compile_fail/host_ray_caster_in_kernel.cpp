// expect: mir: camera rays and paths in a kernel need a ray caster with find_point()
// SPDX-License-Identifier: MIT
#include "mir/accel/kd/kd_rays.hpp"
#include "mir/paths/path_world.hpp"
#include "mir/shading/lambert.hpp"

#ifdef MIR_COMPILE_FAIL
using RayCaster = mir::KdRayCaster<mir::Space::host>;
#else
using RayCaster = mir::KdRayCaster<mir::Space::device>;
#endif

using World = mir::PathWorld<mir::Lambert, RayCaster, mir::KdTreeVisibility<mir::Space::device>,
                             mir::Space::device>;

std::size_t bytes_of_world() { return sizeof(World); }
