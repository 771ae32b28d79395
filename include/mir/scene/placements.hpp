// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/light_kinds.hpp"

#include <array>
#include <vector>

namespace mir {

/// A light that a Scene lists and that lies somewhere.
template <class Light>
concept PlacedLight = requires(Light l) {
    { l.position } -> std::same_as<Vec3&>;
};

/// Calls f(list) with each list of lights of `scene` that lie somewhere.
template <class S, class F>
void for_each_placed_list(S& scene, const F& f) {
    ListedLights::for_each_list(scene, [&f](auto& list) {
        if constexpr (PlacedLight<typename std::remove_cvref_t<decltype(list)>::value_type>)
            f(list);
    });
}

/// Where the things of a Scene stand, in double precision. recentre() reads them before it rounds
/// to floats. Element i is of element i of the list of the Scene that has the same name, which
/// holds everything else about it. Metres, counted from Scene::origin.
struct Placements {
    std::vector<DMat4> instances;  ///< affine, from the mesh to the world
    std::vector<DVec3> cameras;    ///< places
    /// Places of lights, by kind: lights() finds them. Kinds from outside have none.
    std::array<std::vector<DVec3>, ListedLights::size> listed_lights;

    /// Places of the lights of one kind, such as PointLight.
    template <PlacedLight Light>
    [[nodiscard]] std::vector<DVec3>& lights() {
        return listed_lights[ListedLights::index_of<Light>()];
    }
    /// The same, to be read.
    template <PlacedLight Light>
    [[nodiscard]] const std::vector<DVec3>& lights() const {
        return listed_lights[ListedLights::index_of<Light>()];
    }
};

/// The placements that a scene has now.
inline Placements placements_of(const Scene& scene) {
    Placements places;
    for (const Instance& i : scene.instances) places.instances.emplace_back(i.to_world);
    for_each_placed_list(scene, [&places]<class Light>(const std::vector<Light>& list) {
        for (const Light& l : list) places.lights<Light>().emplace_back(l.position);
    });
    for (const Camera& c : scene.cameras) places.cameras.emplace_back(c.position);
    return places;
}

}  // namespace mir
