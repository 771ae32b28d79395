// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/io/scene_report.hpp"
#include "options.hpp"

#include <string>

namespace mirtool {

/// A scene and what its file held.
struct SceneAndReport {
    mir::Scene scene;
    mir::SceneReport report;
};

/// Loads `builtin:NAME` or a file that read_scene() knows, and its
/// surroundings.
/// @throws mir::Error(invalid_input) for whatever is wrong with either, limits included.
SceneAndReport load_scene(const std::string& name, const mir::Limits& limits = {},
                          const EnvironmentOptions& environment = {});

/// Puts light from a file around a scene.
/// @throws mir::Error for a file that cannot be read or holds no light.
void put_environment(SceneAndReport& loaded, const EnvironmentOptions& environment,
                     const mir::Limits& limits);

/// The name without folder and extension, for default output names.
std::string stem_of(const std::string& name);

}  // namespace mirtool
