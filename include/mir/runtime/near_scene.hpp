// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/stage_clock.hpp"
#include "mir/scene/recentre.hpp"

#include <string>
#include <vector>

namespace mir {

/// What a renderer renders in the place of `scene`, which must outlive it; what was too coarse is
/// added to `warnings`.
inline NearScene near_scene(const Scene& scene, StageClock& clock,
                            std::vector<std::string>& warnings) {
    const auto stage = clock.measure(&StageSeconds::geometry);
    NearScene near(scene);
    warnings.insert(warnings.end(), near.remarks().begin(), near.remarks().end());
    return near;
}

}  // namespace mir
