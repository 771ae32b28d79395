// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/shapes.hpp"

#include <initializer_list>
#include <span>

namespace mir::builtin {

/// A mesh without anything in it yet.
inline Mesh empty_mesh(std::string name, std::uint32_t material) {
    Mesh m;
    m.name = std::move(name);
    m.material = material;
    return m;
}

/// Adds the vertices and triangles of `other`; both have normals or neither has.
inline void append(Mesh& m, const Mesh& other) {
    const auto first = static_cast<std::uint32_t>(m.positions.size());
    m.positions.insert(m.positions.end(), other.positions.begin(), other.positions.end());
    m.normals.insert(m.normals.end(), other.normals.begin(), other.normals.end());
    for (const TriangleIndices& t : other.triangles)
        m.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// One mesh of several.
inline Mesh joined(std::string name, std::uint32_t material, std::initializer_list<Mesh> parts) {
    Mesh m = empty_mesh(std::move(name), material);
    for (const Mesh& part : parts) append(m, part);
    return m;
}

/// Translates by `offset`.
inline Mesh moved(Mesh m, Vec3 offset) {
    for (Vec3& p : m.positions) p += offset;
    return m;
}

/// Mirrored in the plane x = 0; the front stays outside.
inline Mesh mirrored(Mesh m) {
    for (Vec3& p : m.positions) p.x = -p.x;
    for (Vec3& n : m.normals) n.x = -n.x;
    for (TriangleIndices& t : m.triangles) std::swap(t[1], t[2]);
    return m;
}

/// Gives every vertex the mean normal of its triangles, weighted by area.
inline Mesh smooth(Mesh m) {
    m.normals.assign(m.positions.size(), Vec3(0.0f));
    for (const TriangleIndices& t : m.triangles) {
        const Vec3 a = m.positions[t[0]];
        const Vec3 n = glm::cross(m.positions[t[1]] - a, m.positions[t[2]] - a);
        for (const std::uint32_t v : t) m.normals[v] += n;
    }
    for (Vec3& n : m.normals) {
        const float length = glm::length(n);
        n = length > 0.0f ? n / length : Vec3(0.0f, 1.0f, 0.0f);
    }
    return m;
}

/// Which directions of a grid of vertices close on themselves.
enum class Wrap { none, columns, both };

/// Joins vertices that lie row by row by two triangles per cell. They begin at index `first`. The
/// front is where (next column) x (next row) points.
inline void connect(Mesh& m, std::uint32_t first, std::uint32_t columns, std::uint32_t rows,
                    Wrap wrap) {
    const std::uint32_t column_cells = wrap == Wrap::none ? columns - 1 : columns;
    const std::uint32_t row_cells = wrap == Wrap::both ? rows : rows - 1;
    for (std::uint32_t r = 0; r < row_cells; ++r)
        for (std::uint32_t c = 0; c < column_cells; ++c) {
            const std::uint32_t below = first + r * columns;
            const std::uint32_t above = first + (r + 1) % rows * columns;
            const std::uint32_t next = (c + 1) % columns;
            m.triangles.push_back({below + c, below + next, above + next});
            m.triangles.push_back({below + c, above + next, above + c});
        }
}

/// Rounded box: the points of a ball in the norm of exponent 4. `shape` carries them (columns: half
/// axes and centre, right-handed). 2 segments (rings - 1) triangles, smooth.
inline Mesh cushion(std::string name, std::uint32_t material, const Mat4& shape,
                    std::uint32_t segments, std::uint32_t rings) {
    Mesh m = sphere(std::move(name), material, Vec3(0.0f), 1.0f, segments, rings);
    for (Vec3& p : m.positions) {
        // sin(pi) is not 0 in floats, but the corners of a pole must be one point.
        if (p.y == -1.0f) p = {0, -1, 0};
        const Vec3 q = p * p;
        p = Vec3(shape * Vec4(p / std::sqrt(std::sqrt(glm::dot(q, q))), 1.0f));
    }
    return smooth(std::move(m));
}

/// Half axes along x, y, z, turned about x, then moved to `centre`. `pitch` is in radians.
inline Mat4 placed(Vec3 half, Vec3 centre, float pitch = 0.0f) {
    const float c = std::cos(pitch);
    const float s = std::sin(pitch);
    return {Vec4(half.x, 0, 0, 0), half.y * Vec4(0, c, s, 0), half.z * Vec4(0, -s, c, 0),
            Vec4(centre, 1.0f)};
}

/// Turned by `angle` about the vertical, then moved to `centre`.
inline Mat4 turned(float angle, Vec3 centre) {
    const float c = std::cos(angle);
    const float d = std::sin(angle);
    return {Vec4(c, 0, -d, 0), Vec4(0, 1, 0, 0), Vec4(d, 0, c, 0), Vec4(centre, 1)};
}

/// Ring swept by a closed profile of (distance from the x axis, x). It runs clockwise with x to the
/// right and the distance up; 2 segments |profile| triangles, smooth.
inline Mesh lathe(std::string name, std::uint32_t material, std::span<const Vec2> profile,
                  std::uint32_t segments) {
    Mesh m = empty_mesh(std::move(name), material);
    for (std::uint32_t s = 0; s < segments; ++s) {
        const float phi = 2.0f * pi * static_cast<float>(s) / static_cast<float>(segments);
        for (const Vec2 p : profile)
            m.positions.emplace_back(p.y, p.x * std::cos(phi), -p.x * std::sin(phi));
    }
    connect(m, 0, static_cast<std::uint32_t>(profile.size()), segments, Wrap::both);
    return smooth(std::move(m));
}

}  // namespace mir::builtin
