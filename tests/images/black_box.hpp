// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scenes.hpp"
#include "support/test_sky.hpp"

namespace mirtest {

/// A box that reflects nothing under a sky of radiance 1 from all around: a pixel shows what of it
/// is no surface.
inline mir::Scene black_box() {
    mir::Scene scene = mir::builtin::make("cornell-box");
    for (mir::Material& m : scene.materials) {
        m.emission = {};
        m.base_color = {};
        m.textures = {};
        m.metallic = 0.0f;
        m.specular = 0.0f;
    }
    scene.environment = constant_sky({1, 1, 1});
    // Back and aside, so that slanted edges cross pixels.
    scene.cameras[0].position += 1.5f * scene.cameras[0].back + 0.7f * scene.cameras[0].up;
    return scene;
}

}  // namespace mirtest
