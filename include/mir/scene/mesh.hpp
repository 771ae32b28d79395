// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mir {

using TriangleIndices = std::array<std::uint32_t, 3>;

/// Triangles in their own coordinate system, metres. Counter-clockwise seen from the front.
struct Mesh {
    std::string name;
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;  ///< unit, one per position; empty: the triangles are flat
    std::vector<TriangleIndices> triangles;
    std::uint32_t material = 0;  ///< index into Scene::materials
};

/// A mesh placed in the world. A mirroring transform keeps the front of the mesh in front.
struct Instance {
    std::uint32_t mesh = 0;  ///< index into Scene::meshes
    Mat4 to_world{1.0f};     ///< affine
};

}  // namespace mir
