// SPDX-License-Identifier: MIT
#pragma once

#include "load_scene.hpp"
#include "options.hpp"

namespace mirtool {

/// Puts the sun, the ground and the camera that were asked for into a scene. It may have none.
/// @throws mir::Error(invalid_argument) for a sun without direction, and a camera without.
void add_to_scene(const AddedScene& added, SceneAndReport& loaded);

}  // namespace mirtool
