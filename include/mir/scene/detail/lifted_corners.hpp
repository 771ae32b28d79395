// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/detail/lamp_faces.hpp"

#include <array>
#include <map>
#include <tuple>
#include <vector>

namespace mir::detail {

/// Direction that comes out of surfaces with these unit normals, with a component of one along the
/// normal that it is furthest from. `own`, one of them, where the surfaces turn too far from each
/// other for that.
[[nodiscard]] inline Vec3 way_out(const std::vector<Vec3>& normals, Vec3 own) {
    Vec3 sum(0.0f);
    for (const Vec3 n : normals) sum += n;
    const float length = glm::length(sum);
    if (!(length > 0.0f)) return own;
    const Vec3 mean = sum / length;
    float least = 1.0f;
    for (const Vec3 n : normals) least = smaller(least, glm::dot(mean, n));
    return least > 0.5f ? mean / least : own;
}

/// Where the corners of lifted faces lie, in the order of their triangles' corners: `step` metres a
/// level before the lamp. Faces of one level that meet in a corner still meet there, unless they
/// turn by more than 120 degrees.
[[nodiscard]] inline std::vector<std::array<Vec3, 3>> lifted_corners(
    const GeometryView<Space::host>& geometry, const std::vector<LampFace>& faces, float step) {
    using Place = std::tuple<float, float, float, std::uint32_t, bool>;
    const auto normal_of = [&](const LampFace& f) {
        const Vec3 normal = geometry.front_normal(f.triangle);
        return f.front ? normal : -normal;
    };
    const auto place_of = [&](const LampFace& f, std::uint32_t k) {
        const Vec3 p = geometry.corner(f.triangle, k);
        return Place{p.x, p.y, p.z, f.level, f.front};
    };
    std::map<Place, std::vector<Vec3>> normals;
    for (const LampFace& f : faces)
        for (std::uint32_t k = 0; k < 3; ++k) normals[place_of(f, k)].push_back(normal_of(f));
    std::vector<std::array<Vec3, 3>> corners(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const Vec3 way = way_out(normals.at(place_of(faces[i], k)), normal_of(faces[i]));
            corners[i][k] = geometry.corner(faces[i].triangle, k) +
                            (static_cast<float>(faces[i].level) * step) * way;
        }
    return corners;
}

}  // namespace mir::detail
