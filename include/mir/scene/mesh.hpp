// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mir {

/// Vertices of a triangle, counter-clockwise seen from the front. A type of its own, because device
/// code cannot index std::array.
struct TriangleIndices {
    std::uint32_t vertex[3] = {};  ///< indices into the positions of a mesh or of a WorldGeometry

    /// Corner `k`, 0..2, unchecked.
    [[nodiscard]] MIR_HD constexpr std::uint32_t& operator[](std::size_t k) { return vertex[k]; }
    /// Corner `k`, 0..2, unchecked.
    [[nodiscard]] MIR_HD constexpr std::uint32_t operator[](std::size_t k) const {
        return vertex[k];
    }
    /// Corners in order, for loops; on the host only.
    [[nodiscard]] constexpr std::uint32_t* begin() { return vertex; }
    /// Behind the third corner.
    [[nodiscard]] constexpr std::uint32_t* end() { return vertex + 3; }
    /// As above, to read.
    [[nodiscard]] constexpr const std::uint32_t* begin() const { return vertex; }
    /// As above, to read.
    [[nodiscard]] constexpr const std::uint32_t* end() const { return vertex + 3; }
    /// The same vertices in the same order: a turned triangle is another.
    friend constexpr bool operator==(const TriangleIndices&, const TriangleIndices&) = default;
};

/// Triangles in their own coordinate system, metres. Counter-clockwise seen from the front.
struct Mesh {
    std::string name;             ///< for messages and files
    std::vector<Vec3> positions;  ///< finite, metres
    std::vector<Vec3> normals;    ///< unit, one per position; empty: the triangles are flat
    std::vector<TriangleIndices> triangles;  ///< indices into positions
    std::uint32_t material = 0;              ///< index into Scene::materials
    std::vector<Vec2> texture_coordinates;   ///< one per position; empty: no texture is used
    std::vector<Rgb> colors;  ///< linear, 0..1, one per position; they multiply the base colour;
                              ///< empty: white
};

/// A mesh placed in the world. A mirroring transform keeps the front of the mesh in front.
struct Instance {
    std::uint32_t mesh = 0;  ///< index into Scene::meshes
    Mat4 to_world{1.0f};     ///< affine
};

}  // namespace mir
