// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/scene/scene.hpp"

#include <cmath>
#include <string>

namespace mir::detail {

/// Texture coordinates and colours. One for each vertex, or none, and of numbers that can be used.
/// @throws Error(invalid_input) that names mesh and place, as do the others.
inline void check_attributes(const Mesh& mesh) {
    const auto check = [&](const char* what, std::size_t count, auto&& is_good) {
        if (count == 0) return;
        if (count != mesh.positions.size())
            throw Error(ErrorCode::invalid_input, "mesh " + in_quotes(mesh.name) + ": it has " +
                                                      std::to_string(count) + " " + what + " for " +
                                                      std::to_string(mesh.positions.size()) +
                                                      " positions; give one each or none");
        for (std::size_t i = 0; i < count; ++i)
            if (!is_good(i))
                throw Error(ErrorCode::invalid_input,
                            "mesh " + in_quotes(mesh.name) + ": number " + std::to_string(i) +
                                " of its " + what +
                                " is not finite or not a colour; repair the file");
    };
    check("texture coordinates", mesh.texture_coordinates.size(), [&](std::size_t i) {
        const Vec2 uv = mesh.texture_coordinates[i];
        return std::isfinite(uv.x) && std::isfinite(uv.y);
    });
    check("colors", mesh.colors.size(), [&](std::size_t i) {
        const Rgb c = mesh.colors[i];
        const auto is_share = [](float x) { return x >= 0.0f && x <= 1.0f; };
        return is_share(c.r) && is_share(c.g) && is_share(c.b);
    });
}

/// One mesh of the scene: materials, vertices and indices that exist.
inline void check_mesh(const Scene& scene, const Mesh& mesh) {
    const auto fail = [&](const std::string& what) {
        throw Error(ErrorCode::invalid_input, "mesh " + in_quotes(mesh.name) + ": " + what);
    };
    if (mesh.material >= scene.materials.size())
        fail("material " + std::to_string(mesh.material) + " does not exist (the scene has " +
             std::to_string(scene.materials.size()) + "); add it or correct the index");
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size())
        fail("it has " + std::to_string(mesh.normals.size()) + " normals for " +
             std::to_string(mesh.positions.size()) + " positions; give one each or none");
    check_attributes(mesh);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (!is_finite(mesh.positions[i]))
            fail("position " + std::to_string(i) +
                 " is not finite (nothing can be built around it); repair the file");
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (std::uint32_t v : mesh.triangles[i])
            if (v >= mesh.positions.size())
                fail("triangle " + std::to_string(i) + " uses vertex " + std::to_string(v) +
                     " of " + std::to_string(mesh.positions.size()) + "; repair the indices");
}

/// Meshes that instances name, and triangles and vertices of all instances together.
/// @throws Error(invalid_input); Error(limit_exceeded).
inline void check_instances(const Scene& scene, const Limits& limits) {
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    for (const Instance& instance : scene.instances) {
        if (instance.mesh >= scene.meshes.size())
            throw Error(ErrorCode::invalid_input,
                        "an instance names mesh " + std::to_string(instance.mesh) +
                            ", but the scene has " + std::to_string(scene.meshes.size()) +
                            "; correct the index");
        triangles += scene.meshes[instance.mesh].triangles.size();
        vertices += scene.meshes[instance.mesh].positions.size();
    }
    check_limit(triangles, limits.triangles, "triangles");
    check_limit(vertices, limits.vertices, "vertices");
}

}  // namespace mir::detail
