// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_lights.hpp"
#include "mir/core/number_text.hpp"
#include "mir/scene/camera.hpp"

#include <tiny_gltf.h>

#include <cmath>
#include <cstdint>
#include <string>

namespace mir::detail {

inline bool is_orthonormal(const GltfPose& p) {
    const auto near = [](float value, float wanted) { return std::fabs(value - wanted) < 1e-6f; };
    return near(length_squared(p.x), 1) && near(length_squared(p.y), 1) &&
           near(length_squared(p.z), 1) && near(glm::dot(p.x, p.y), 0) &&
           near(glm::dot(p.y, p.z), 0) && near(glm::dot(p.z, p.x), 0);
}

/// Axes of a camera: the node's, without scale and shear. A mirror among the nodes
/// above mirrors the picture.
/// @throws Error(invalid_input) when the node flattens space.
inline void aim_camera(const GltfPose& given, const std::string& place, Camera& camera) {
    const int exponent = given.z == Vec3(0.0f) ? 0 : exponent_to_unit(given.z);
    const GltfPose pose{given.position, times_power_of_two(given.x, exponent),
                        times_power_of_two(given.y, exponent),
                        times_power_of_two(given.z, exponent)};
    camera.right = pose.x;
    camera.up = pose.y;
    camera.back = pose.z;
    if (is_orthonormal(pose)) return;
    camera.back = unit_direction(pose.z);
    camera.right = unit_direction(pose.x - glm::dot(pose.x, camera.back) * camera.back);
    if (camera.back == Vec3(0.0f) || camera.right == Vec3(0.0f))
        gltf_fail(place,
                  "it holds a camera but flattens space (a scale of zero); repair the scale");
    camera.up = glm::cross(camera.back, camera.right);
    if (glm::dot(camera.up, pose.y) < 0.0f) camera.up = -camera.up;
}

/// Width or height that extras.resolution asks for, 0 when not given.
inline std::uint32_t asked_pixels(const tinygltf::Value& extras, int axis) {
    if (!extras.Has("resolution")) return 0;
    const tinygltf::Value& both = extras.Get("resolution");
    if (both.ArrayLen() != 2 || !both.Get(axis).IsNumber()) return 0;
    const double pixels = both.Get(axis).GetNumberAsDouble();
    return pixels >= 1.0 && pixels <= 1e6 ? static_cast<std::uint32_t>(pixels) : 0;
}

inline Camera perspective_camera(const tinygltf::Camera& from, const std::string& place) {
    Camera camera;
    const double fov = from.perspective.yfov;
    if (!(fov > 0.0 && fov < 3.14159))
        gltf_fail(place,
                  "its yfov is not between 0 and pi (" + number_text(fov) + "); repair the value");
    camera.vertical_fov = static_cast<float>(fov);
    camera.aspect_ratio = checked_amount(from.perspective.aspectRatio, "aspectRatio", place);
    camera.lens_radius = checked_amount(number_or(from.extras, "lens_radius", 0.0, place),
                                        "extras.lens_radius", place);
    camera.focus_distance = checked_amount(number_or(from.extras, "focus_distance", 1.0, place),
                                           "extras.focus_distance", place);
    return camera;
}

/// Adds the camera `index` and its place, as placed by a node. Or reports why it cannot be used;
/// the place goes to `places`.
/// @throws Error(invalid_input)
inline void add_camera(const tinygltf::Model& model, int index, const PlacedNode& placed,
                       Scene& scene, Placements& places, SceneReport& report) {
    const std::string user = node_place(model, placed.node);
    const auto at = checked_index(index, model.cameras.size(), "camera", user);
    const tinygltf::Camera& from = model.cameras[at];
    CameraReport entry;
    entry.name = from.name.empty() ? model.nodes[placed.node].name : from.name;
    entry.kind = from.type;
    entry.width = asked_pixels(from.extras, 0);
    entry.height = asked_pixels(from.extras, 1);
    if (from.type != "perspective") {
        ++report.ignored["camera of type '" + from.type + "'"];
        report.cameras.push_back(entry);
        return;
    }
    Camera camera = perspective_camera(from, gltf_place("camera", at, from.name));
    camera.name = entry.name;
    const GltfPose pose = pose_of(placed, user);
    aim_camera(pose, user, camera);
    entry.index = static_cast<std::uint32_t>(scene.cameras.size());
    scene.cameras.push_back(camera);
    places.cameras.push_back(pose.position);
    report.cameras.push_back(entry);
}

}  // namespace mir::detail
