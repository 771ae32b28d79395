// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/scene_report.hpp"
#include "mir/scene/scene.hpp"

namespace mir {

/// A scene from a file, and what was found and left out on the way.
struct LoadedScene {
    Scene scene;
    SceneReport report;
};

}  // namespace mir
