// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

#include <nanobind/nanobind.h>

namespace mirpy {

/// Three finite numbers as a vector.
/// @throws ArgumentError that calls them `place`.
mir::Vec3 vector_of(nanobind::handle value, const char* place);

/// Three finite numbers as a colour.
/// @throws ArgumentError that calls them `place`.
mir::Rgb rgb_of(nanobind::handle value, const char* place);

/// A colour of light.
/// @throws ArgumentError that calls it `place`, also where a number is negative.
mir::Rgb light_of(nanobind::handle value, const char* place);

}  // namespace mirpy
