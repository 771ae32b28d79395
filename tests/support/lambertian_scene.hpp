// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"

namespace mirtest {

/// The scene with every material purely Lambertian; colours, textures and light stay.
inline mir::Scene all_lambertian(mir::Scene scene) {
    for (mir::Material& m : scene.materials) m.metallic = m.specular = 0.0f;
    return scene;
}

}  // namespace mirtest
