// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/scene_report.hpp"
#include "mir/scene/scene.hpp"

namespace mir {

/// A scene from a file, and what was found and left out on the way.
struct LoadedScene {
    Scene scene;         ///< every index in it is valid
    SceneReport report;  ///< counts what `scene` holds
};

}  // namespace mir
