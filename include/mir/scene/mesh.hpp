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
    std::uint32_t vertex[3] = {};

    [[nodiscard]] MIR_HD constexpr std::uint32_t& operator[](std::size_t k) { return vertex[k]; }
    [[nodiscard]] MIR_HD constexpr std::uint32_t operator[](std::size_t k) const {
        return vertex[k];
    }
    [[nodiscard]] constexpr std::uint32_t* begin() { return vertex; }
    [[nodiscard]] constexpr std::uint32_t* end() { return vertex + 3; }
    [[nodiscard]] constexpr const std::uint32_t* begin() const { return vertex; }
    [[nodiscard]] constexpr const std::uint32_t* end() const { return vertex + 3; }
    friend constexpr bool operator==(const TriangleIndices&, const TriangleIndices&) = default;
};

/// Triangles in their own coordinate system, metres. Counter-clockwise seen from the front.
struct Mesh {
    std::string name;
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;  ///< unit, one per position; empty: the triangles are flat
    std::vector<TriangleIndices> triangles;
    std::uint32_t material = 0;             ///< index into Scene::materials
    std::vector<Vec2> texture_coordinates;  ///< one per position; empty: no texture is used
    std::vector<Rgb> colors;  ///< linear, 0..1, one per position; they multiply the base colour;
                              ///< empty: white
};

/// A mesh placed in the world. A mirroring transform keeps the front of the mesh in front.
struct Instance {
    std::uint32_t mesh = 0;  ///< index into Scene::meshes
    Mat4 to_world{1.0f};     ///< affine
};

}  // namespace mir
