// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scenes.hpp"

#include <string>

namespace mirtool {

/// Names of the scenes behind "builtin:".
inline std::string scene_names(const std::string& between, const std::string& prefix = "") {
    std::string text;
    for (const auto& scene : mir::builtin::scenes)
        text += (text.empty() ? prefix : between + prefix) + std::string(scene.name);
    return text;
}

}  // namespace mirtool
