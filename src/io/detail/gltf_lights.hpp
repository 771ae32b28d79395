// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_meshes.hpp"
#include "io/detail/gltf_nodes.hpp"
#include "mir/core/number_text.hpp"
#include "mir/scene/placements.hpp"

#include <tiny_gltf.h>

#include <cmath>
#include <string>

namespace mir::detail {

/// Where a light or a camera stands and how it is turned. Columns need not be unit.
struct GltfPose {
    DVec3 position{0.0};
    Vec3 x{1, 0, 0};
    Vec3 y{0, 1, 0};
    Vec3 z{0, 0, 1};
};

inline GltfPose pose_of(const PlacedNode& placed, const std::string& place) {
    const Mat4 m(checked_matrix(placed.turn, place));
    const DMat4& at = checked_matrix(placed.to_world, place);
    return {DVec3(at[3]), Vec3(m[0]), Vec3(m[1]), Vec3(m[2])};
}

/// Unit direction in which a light shines: -z of its node.
inline Vec3 shining_direction(const GltfPose& pose, const std::string& place) {
    const Vec3 direction = unit_direction(-pose.z);
    if (direction == Vec3(0.0f))
        gltf_fail(place, "it has no direction (its node is scaled to nothing); repair the scale");
    return direction;
}

/// Colour x intensity of a light, in the light's own unit.
inline Rgb light_strength(const tinygltf::Light& light, const std::string& place) {
    const auto channel = [&](std::size_t k) {
        const double color = light.color.empty() ? 1.0 : light.color[k];
        (void)checked_amount(color, "its colour", place);
        (void)checked_amount(light.intensity, "its intensity", place);
        return checked_amount(color * light.intensity, "its colour x intensity", place);
    };
    if (!light.color.empty() && light.color.size() != 3)
        gltf_fail(place, "its colour has " + std::to_string(light.color.size()) +
                             " numbers instead of 3; repair it");
    return {channel(0), channel(1), channel(2)};
}

/// Cosine of an angle of 0..pi/2 radians, as the sine of the rest. Exactly 0 at a right angle.
inline float cone_cosine(double angle) {
    return static_cast<float>(std::sin(0.5 * 3.14159265358979323846 - angle));
}

inline SpotLight spot_light(const tinygltf::Light& light, const GltfPose& pose,
                            const std::string& place) {
    const double inner = light.spot.innerConeAngle;
    const double outer = light.spot.outerConeAngle;
    // A half angle of 90 degrees is written rounded up by some exporters.
    if (!(inner >= 0.0 && inner < outer && outer <= 1.5708))
        gltf_fail(place, "its cone angles are not in order (0 <= inner " + number_text(inner) +
                             " < outer " + number_text(outer) + " <= pi/2); repair them");
    SpotLight spot;
    spot.direction = shining_direction(pose, place);
    spot.intensity = light_strength(light, place);
    spot.cos_inner = cone_cosine(inner);
    spot.cos_outer = cone_cosine(outer);
    return spot;
}

/// Adds the KHR_lights_punctual light `index`, its place to `places`, as placed by a node. Candela
/// and lux are taken as W/sr and W/m^2: no photometric conversion is made, results scale linearly.
/// @throws Error(invalid_input)
inline void add_light(const tinygltf::Model& model, int index, const PlacedNode& placed,
                      Scene& scene, Placements& places, SceneReport& report) {
    const std::string user = node_place(model, placed.node);
    const auto at = checked_index(index, model.lights.size(), "light", user);
    const tinygltf::Light& light = model.lights[at];
    const std::string place = gltf_place("light", at, light.name);
    const GltfPose pose = pose_of(placed, user);
    const std::string name = light.name.empty() ? model.nodes[placed.node].name : light.name;
    const std::uint16_t group = light_group_of(light.extras, place);
    if (light.range > 0.0) ++report.ignored["range of a light"];
    if (light.type == "point") {
        scene.point_lights.push_back({name, {}, light_strength(light, place), group});
        places.lights<PointLight>().push_back(pose.position);
    } else if (light.type == "spot") {
        SpotLight spot = spot_light(light, pose, place);
        spot.name = name;
        spot.light_group = group;
        scene.spot_lights.push_back(spot);
        places.lights<SpotLight>().push_back(pose.position);
    } else if (light.type == "directional") {
        scene.directional_lights.push_back(
            {name, shining_direction(pose, place), light_strength(light, place), group});
    } else {
        ++report.ignored["light of type '" + light.type + "'"];
    }
}

}  // namespace mir::detail
