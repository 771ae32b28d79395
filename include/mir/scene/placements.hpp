// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"

#include <vector>

namespace mir {

/// Where the things of a Scene stand, in double precision: what recentre() reads before it rounds
/// to floats. Element i is of element i of the list of the Scene that has the same name, which
/// holds everything else about it. Metres, counted from Scene::origin.
struct Placements {
    std::vector<DMat4> instances;     ///< affine, from the mesh to the world
    std::vector<DVec3> point_lights;  ///< places
    std::vector<DVec3> spot_lights;   ///< places
    std::vector<DVec3> cameras;       ///< places
};

/// The placements that a scene has now.
inline Placements placements_of(const Scene& scene) {
    Placements places;
    for (const Instance& i : scene.instances) places.instances.emplace_back(i.to_world);
    for (const PointLight& l : scene.point_lights) places.point_lights.emplace_back(l.position);
    for (const SpotLight& l : scene.spot_lights) places.spot_lights.emplace_back(l.position);
    for (const Camera& c : scene.cameras) places.cameras.emplace_back(c.position);
    return places;
}

}  // namespace mir
