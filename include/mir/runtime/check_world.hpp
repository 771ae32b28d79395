// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/runtime/check_places.hpp"
#include "mir/scene/scene.hpp"
#include "mir/scene/world_geometry.hpp"

#include <cstdint>
#include <string>

namespace mir {

/// Checks what check_scene() cannot see before the triangles of a scene are placed. That some are
/// left, and check_places().
/// @throws Error(invalid_input)
inline void check_world(const Scene& scene, std::uint32_t camera, const WorldGeometry& world) {
    check_places(scene, camera, world.bounds());
    if (!world.triangles().empty()) return;
    throw Error(ErrorCode::invalid_input,
                "the scene has nothing to draw (none of its " +
                    std::to_string(world.dropped_triangles()) +
                    " triangles has an area); check the scale of what it places");
}

}  // namespace mir
