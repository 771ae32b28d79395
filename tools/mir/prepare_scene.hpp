// SPDX-License-Identifier: MIT
#pragma once

#include "load_scene.hpp"
#include "options.hpp"

namespace mirtool {

/// Which view of a scene is rendered, where the scene has none.
struct ChosenView {
    bool framed = false;  ///< the scene has no usable camera, and was given one
    bool inside = false;  ///< it is a room, seen from inside
};

/// True when prepare_scene() would add something to the scene.
bool adds_to_scene(const RenderOptions& options, const mir::SceneReport& report);

/// Asks the render for the layers of the picture that it does not make anyway.
void choose_layers(RenderOptions& options);

/// Adds what was asked for to a scene, chooses camera and size, and checks that it can be rendered.
/// @throws mir::Error for cameras that are not there and scenes that cannot be rendered.
ChosenView prepare_scene(RenderOptions& options, SceneAndReport& loaded);

}  // namespace mirtool
