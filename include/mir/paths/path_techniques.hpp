// SPDX-License-Identifier: MIT
#pragma once

namespace mir {

/// Ways to build a path.
enum class PathTechniques {
    camera,        ///< from the camera, closed by one light sample
    bidirectional  ///< a part from the camera and a part from a light, connected
};

}  // namespace mir
