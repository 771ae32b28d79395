// SPDX-License-Identifier: MIT
#include "added_scene.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace mirtool {
namespace {

constexpr float ground_reflectance = 0.5f;
/// Sides of the ground in diameters of the scene.
constexpr float ground_size = 8.0f;

mir::Rgb grey(float value) { return {value, value, value}; }

/// A horizontal square below the scene, faced up.
mir::Mesh ground_mesh(const mir::Bounds& bounds, std::uint32_t material) {
    const mir::Vec3 centre = bounds.centre();
    const float half = 0.5f * ground_size * bounds.diagonal();
    mir::Mesh mesh;
    mesh.name = "ground";
    mesh.material = material;
    for (const mir::Vec2 corner :
         {mir::Vec2(-1, -1), mir::Vec2(-1, 1), mir::Vec2(1, 1), mir::Vec2(1, -1)})
        mesh.positions.emplace_back(centre.x + half * corner.x, bounds.low.y,
                                    centre.z + half * corner.y);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

/// `bounds` count from `origin`, a place of the file like those of `added`.
/// @throws mir::Error(invalid_argument) unless it looks somewhere.
mir::Camera camera_of(const AddedScene& added, const mir::Bounds& bounds, mir::DVec3 origin) {
    const mir::Vec3 eye(*added.eye - origin);
    const mir::Vec3 target = added.look_at ? mir::Vec3(*added.look_at - origin) : bounds.centre();
    const mir::Vec3 direction = target - eye;
    mir::expects(glm::length(direction) > 0.0f && std::isfinite(glm::length(direction)),
                 "the camera of --eye is where it looks at (it has no direction); move it, or "
                 "give another --look-at");
    // Straight up or down, the top of the picture is away from the viewer on the ground.
    const bool upright = std::hypot(direction.x, direction.z) < 1e-4f * glm::length(direction);
    const mir::Vec3 up = upright ? mir::Vec3(0, 0, -1) : mir::Vec3(0, 1, 0);
    const float radians = added.fov * std::numbers::pi_v<float> / 180.0f;
    mir::Camera camera = mir::Camera::look_at(eye, target, up, radians);
    camera.name = "--eye";
    return camera;
}

}  // namespace

void add_sun_and_camera(const AddedScene& added, SceneAndReport& loaded) {
    mir::Scene& scene = loaded.scene;
    if (added.sun) {
        const mir::Vec3 towards(*added.sun);
        const float length = glm::length(towards);
        mir::expects(length > 0.0f && std::isfinite(length),
                     "the sun of --sun is in no direction; give one such as 1,2,1");
        mir::DirectionalLight sun;
        sun.name = "sun";
        sun.direction = -towards / length;
        sun.irradiance = grey(added.sun_irradiance);
        scene.directional_lights.push_back(sun);
    }
    if (!added.eye) return;
    scene.cameras.push_back(camera_of(added, loaded.report.bounds, scene.origin));
    mir::CameraReport report;
    report.name = scene.cameras.back().name;
    report.kind = "perspective";
    report.index = static_cast<std::uint32_t>(scene.cameras.size() - 1);
    // The first of the list is the one that is used.
    loaded.report.cameras.insert(loaded.report.cameras.begin(), report);
}

void add_ground(const AddedScene& added, SceneAndReport& loaded) {
    mir::Scene& scene = loaded.scene;
    if (!added.ground || scene.instances.empty()) return;
    const std::uint32_t material = scene.add(mir::lambertian("ground", grey(ground_reflectance)));
    scene.place(ground_mesh(loaded.report.bounds, material));
}

}  // namespace mirtool
