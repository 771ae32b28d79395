// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/result.hpp"
#include "mir/runtime/stage_clock.hpp"
#include "mir/scene/recentre.hpp"
#include "mir/scene/world_geometry.hpp"

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

/// Writes how many triangles are rendered, how many are not, and how many lie in one place.
inline void count_triangles(const WorldGeometry& geometry, RenderStatistics& s) {
    s.triangles = geometry.triangles().size();
    s.dropped_triangles = geometry.dropped_triangles();
    s.coinciding_triangles = geometry.coinciding_triangles();
}

}  // namespace mir
