// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/mesh.hpp"
#include "support/quadrature.hpp"

#include <array>
#include <map>

namespace mirtest {

/// Unit normal of the front of a triangle, zero when it has no area.
inline mir::Vec3 normal(const mir::Mesh& m, const mir::TriangleIndices& t) {
    const mir::Vec3 n =
        glm::cross(m.positions[t[1]] - m.positions[t[0]], m.positions[t[2]] - m.positions[t[0]]);
    const float length = glm::length(n);
    return length > 0.0f ? n / length : mir::Vec3(0);
}

/// m^2.
inline double area(const mir::Mesh& m) {
    double sum = 0.0;
    for (const auto& t : m.triangles)
        sum += 0.5 *
               static_cast<double>(glm::length(glm::cross(m.positions[t[1]] - m.positions[t[0]],
                                                          m.positions[t[2]] - m.positions[t[0]])));
    return sum;
}

/// Volume that a closed mesh encloses, m^3; negative when its front is inside.
inline double volume(const mir::Mesh& m) {
    double sum = 0.0;
    for (const auto& t : m.triangles)
        sum += static_cast<double>(
                   glm::dot(m.positions[t[0]], glm::cross(m.positions[t[1]], m.positions[t[2]]))) /
               6.0;
    return sum;
}

/// True when every edge is used once in each direction. Vertices that agree after rounding to
/// multiples of `grid` metres count as one.
inline bool is_closed(const mir::Mesh& m, float grid = 1e-6f) {
    using Corner = std::array<long, 3>;
    const auto corner = [&](std::uint32_t v) {
        const mir::Vec3 p = m.positions[v] / grid;
        return Corner{std::lround(p.x), std::lround(p.y), std::lround(p.z)};
    };
    std::map<std::array<Corner, 2>, int> balance;
    for (const auto& t : m.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const Corner a = corner(t[k]);
            const Corner b = corner(t[(k + 1) % 3]);
            if (a < b)
                ++balance[{a, b}];
            else
                --balance[{b, a}];
        }
    for (const auto& [edge, difference] : balance)
        if (difference != 0) return false;
    return true;
}

}  // namespace mirtest
