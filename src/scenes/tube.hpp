// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/solids.hpp"

#include <initializer_list>
#include <span>

namespace mir::builtin {

/// Unit vector at a right angle to `along`, as near to `wanted` as can be. `along` is a unit
/// vector.
inline Vec3 beside(Vec3 along, Vec3 wanted) {
    Vec3 side = wanted - glm::dot(wanted, along) * along;
    if (length_squared(side) < 1e-6f) side = glm::cross(along, Vec3(along.y, along.z, along.x));
    return glm::normalize(side);
}

/// Adds a closed tube of `sides` corners around a line of points, flat ends included. 2 sides
/// |line| - 4 triangles. Smooth around, sharp at the ends.
inline void add_tube(Mesh& m, std::span<const Vec3> line, float radius, std::uint32_t sides) {
    const auto first = static_cast<std::uint32_t>(m.positions.size());
    const auto rings = static_cast<std::uint32_t>(line.size());
    Vec3 side(0.0f, 1.0f, 0.0f);
    for (std::uint32_t r = 0; r < rings; ++r) {
        const Vec3 along =
            glm::normalize(line[r + 1 < rings ? r + 1 : r] - line[r > 0 ? r - 1 : r]);
        side = beside(along, side);
        const Vec3 up = glm::cross(along, side);
        for (std::uint32_t k = 0; k < sides; ++k) {
            const float phi = 2.0f * pi * static_cast<float>(k) / static_cast<float>(sides);
            m.normals.push_back(std::cos(phi) * side + std::sin(phi) * up);
            m.positions.push_back(line[r] + radius * m.normals.back());
        }
    }
    connect(m, first, sides, rings, Wrap::columns);
    for (const bool end : {false, true}) {
        const std::uint32_t ring = first + (end ? (rings - 1) * sides : 0);
        const auto cap = static_cast<std::uint32_t>(m.positions.size());
        const Vec3 out =
            glm::normalize(end ? line[rings - 1] - line[rings - 2] : line[0] - line[1]);
        for (std::uint32_t k = 0; k < sides; ++k) {
            const Vec3 p = m.positions[ring + k];
            m.positions.push_back(p);
            m.normals.push_back(out);
        }
        for (std::uint32_t k = 2; k < sides; ++k)
            m.triangles.push_back(end ? TriangleIndices{cap, cap + k - 1, cap + k}
                                      : TriangleIndices{cap, cap + k, cap + k - 1});
    }
}

/// A tube of its own.
inline Mesh tube(std::string name, std::uint32_t material, std::initializer_list<Vec3> line,
                 float radius, std::uint32_t sides = 12) {
    Mesh m = empty_mesh(std::move(name), material);
    add_tube(m, std::span(line.begin(), line.size()), radius, sides);
    return m;
}

/// Ring of round section about the x axis through the origin.
inline Mesh ring(std::string name, std::uint32_t material, float radius, float thickness,
                 std::uint32_t segments, std::uint32_t sides = 16) {
    std::vector<Vec2> profile;
    for (std::uint32_t k = 0; k < sides; ++k) {
        const float phi = 2.0f * pi * static_cast<float>(k) / static_cast<float>(sides);
        profile.emplace_back(radius + thickness * std::cos(phi), thickness * std::sin(phi));
    }
    return lathe(std::move(name), material, profile, segments);
}

}  // namespace mir::builtin
