// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"

namespace mir::builtin {

/// A sports coupe of 4.4 x 1.9 x 1.4 m, about 480 000 triangles. Glass is left out: thick panels
/// with gaps between them, wheels, seats. `car` carries its frame (car_hull.hpp) into the world.
void place_car(Scene& s, const Mat4& car);

}  // namespace mir::builtin
