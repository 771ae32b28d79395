// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace mir::detail {

/// Some vertices, or triangles, of an instance that are placed together.
struct MeshPart {
    const Instance* instance;
    const Mesh* mesh;
    std::uint32_t first;         ///< in the mesh
    std::uint32_t count;         ///< at least 1
    std::uint32_t first_vertex;  ///< of the instance among all
    std::uint32_t to;            ///< place of the first among all
};

/// All of a scene.
struct MeshParts {
    std::vector<MeshPart> vertices;
    std::vector<MeshPart> triangles;
};

/// Elements that are placed together: enough to hide what a thread costs.
inline constexpr std::uint32_t placed_together = 8192;

/// The instances of a scene, cut into parts that threads can place.
[[nodiscard]] inline MeshParts mesh_parts(const Scene& scene) {
    MeshParts parts;
    std::uint32_t vertices = 0, triangles = 0;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const auto append = [&](std::vector<MeshPart>& to, std::size_t count, std::uint32_t place) {
            for (std::size_t first = 0; first < count; first += placed_together)
                to.push_back({&instance, &mesh, static_cast<std::uint32_t>(first),
                              static_cast<std::uint32_t>(
                                  std::min<std::size_t>(placed_together, count - first)),
                              vertices, place + static_cast<std::uint32_t>(first)});
        };
        append(parts.vertices, mesh.positions.size(), vertices);
        append(parts.triangles, mesh.triangles.size(), triangles);
        vertices += static_cast<std::uint32_t>(mesh.positions.size());
        triangles += static_cast<std::uint32_t>(mesh.triangles.size());
    }
    return parts;
}

}  // namespace mir::detail
