// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/camera.hpp"
#include "mir/scene/environment.hpp"
#include "mir/scene/lights/directional_light.hpp"
#include "mir/scene/lights/point_light.hpp"
#include "mir/scene/lights/spot_light.hpp"
#include "mir/scene/material.hpp"
#include "mir/scene/mesh.hpp"
#include "mir/scene/texture_image.hpp"

#include <optional>
#include <string>
#include <vector>

namespace mir {

/// Everything to render, as plain values. A host renderer fills it from its own data, a file reader
/// from a file. Right-handed, +y up, metres, linear Rec. 709. WorldGeometry and LightTable are made
/// from it; both check it.
///
/// All of it stands in one coordinate system, whose numbers are floats: 100 km from its origin they
/// lie 8 mm apart. recentre() brings a scene that lies far away to its origin and says in `origin`
/// where that is.
struct Scene {
    std::string name;                                  ///< for messages and files
    std::vector<Mesh> meshes;                          ///< each once, however often it is placed
    std::vector<Instance> instances;                   ///< what is seen: a mesh without one is not
    std::vector<Material> materials;                   ///< by Mesh::material
    std::vector<TextureImage> images;                  ///< of the textures of materials
    std::vector<PointLight> point_lights;              ///< without extent: no ray meets them
    std::vector<SpotLight> spot_lights;                ///< without extent: no ray meets them
    std::vector<DirectionalLight> directional_lights;  ///< from outside; no ray meets them
    std::optional<Environment> environment;            ///< light from all around; none: black
    std::vector<Camera> cameras;  ///< by RenderSettings::camera; none: there is no view to render
    /// Place of the scene's (0, 0, 0) in the coordinates of the file; metres. Or in those of the
    /// host. No picture depends on it.
    DVec3 origin{0.0};

    /// Adds a mesh together with one instance of it; returns the index of the mesh.
    std::uint32_t place(Mesh mesh, const Mat4& to_world = Mat4(1.0f)) {
        meshes.push_back(std::move(mesh));
        const auto index = static_cast<std::uint32_t>(meshes.size() - 1);
        instances.push_back({index, to_world});
        return index;
    }

    /// Adds a material; returns its index.
    std::uint32_t add(Material material) {
        materials.push_back(std::move(material));
        return static_cast<std::uint32_t>(materials.size() - 1);
    }
};

}  // namespace mir
