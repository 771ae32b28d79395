// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/mesh.hpp"

namespace mir::builtin {

/// Parallelogram with corners p, p + a, p + a + b, p + b. Its front is where a x b points.
inline Mesh quad(std::string name, std::uint32_t material, Vec3 p, Vec3 a, Vec3 b) {
    Mesh m;
    m.name = std::move(name);
    m.material = material;
    m.positions = {p, p + a, p + a + b, p + b};
    m.triangles = {{0, 1, 2}, {0, 2, 3}};
    return m;
}

/// Parallelepiped spanned by a right-handed frame (a, b, c) at corner p. The front is outside.
inline Mesh box(std::string name, std::uint32_t material, Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    Mesh m;
    m.name = std::move(name);
    m.material = material;
    m.positions = {p, p + a, p + a + b, p + b, p + c, p + a + c, p + a + b + c, p + b + c};
    m.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                   {2, 3, 7}, {2, 7, 6}, {1, 2, 6}, {1, 6, 5}, {0, 4, 7}, {0, 7, 3}};
    return m;
}

/// The same mesh with front and back exchanged.
inline Mesh inside_out(Mesh m) {
    for (TriangleIndices& t : m.triangles) std::swap(t[1], t[2]);
    for (Vec3& n : m.normals) n = -n;
    return m;
}

/// Sphere of `segments` meridians and `rings` parallels with smooth normals, front outside. It has
/// 2 segments (rings - 1) triangles.
inline Mesh sphere(std::string name, std::uint32_t material, Vec3 centre, float radius,
                   std::uint32_t segments, std::uint32_t rings) {
    Mesh m;
    m.name = std::move(name);
    m.material = material;
    for (std::uint32_t r = 0; r <= rings; ++r)
        for (std::uint32_t s = 0; s < segments; ++s) {
            const float theta = pi * static_cast<float>(r) / static_cast<float>(rings);
            const float phi = 2.0f * pi * static_cast<float>(s) / static_cast<float>(segments);
            const Vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta),
                         -std::sin(theta) * std::sin(phi));
            m.normals.push_back(n);
            m.positions.push_back(centre + radius * n);
        }
    for (std::uint32_t r = 0; r < rings; ++r)
        for (std::uint32_t s = 0; s < segments; ++s) {
            const std::uint32_t t = (s + 1) % segments;
            const std::uint32_t above = r * segments;
            const std::uint32_t below = above + segments;
            if (r > 0) m.triangles.push_back({above + s, below + s, above + t});
            if (r + 1 < rings) m.triangles.push_back({above + t, below + s, below + t});
        }
    return m;
}

/// Regular polygon of `corners` corners with the area of the disc of `radius`. The front is where
/// `normal` points; `tangent` is a unit vector in its plane.
inline Mesh disc(std::string name, std::uint32_t material, Vec3 centre, Vec3 normal, Vec3 tangent,
                 float radius, std::uint32_t corners) {
    Mesh m;
    m.name = std::move(name);
    m.material = material;
    const Vec3 bitangent = glm::cross(normal, tangent);
    const float step = 2.0f * pi / static_cast<float>(corners);
    const float reach = radius * std::sqrt(step / std::sin(step));
    m.positions.push_back(centre);
    for (std::uint32_t i = 0; i < corners; ++i) {
        const float phi = step * static_cast<float>(i);
        m.positions.push_back(centre +
                              reach * (std::cos(phi) * tangent + std::sin(phi) * bitangent));
        m.triangles.push_back({0, i + 1, (i + 1) % corners + 1});
    }
    return m;
}

}  // namespace mir::builtin
