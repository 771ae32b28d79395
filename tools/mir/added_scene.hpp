// SPDX-License-Identifier: MIT
#pragma once

#include "load_scene.hpp"
#include "options.hpp"

namespace mirtool {

/// Puts the sun and the camera that were asked for into a scene. It may have none.
/// @throws mir::Error(invalid_argument) for a sun without direction, and a camera without.
void add_sun_and_camera(const AddedScene& added, SceneAndReport& loaded);

/// Puts the ground that was asked for below what the file holds.
void add_ground(const AddedScene& added, SceneAndReport& loaded);

}  // namespace mirtool
