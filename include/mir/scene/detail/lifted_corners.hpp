// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/detail/lamp_faces.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace mir::detail {

/// A corner of a lifted face.
struct FaceCorner {
    Vec3 place;
    std::uint32_t level;
    bool front;
    std::size_t face;
    std::uint32_t corner;  ///< 0..2
    Vec3 normal;           ///< of the face

    /// Corners that are lifted to one place have equal keys.
    [[nodiscard]] auto key() const { return std::tuple(place.x, place.y, place.z, level, front); }
};

/// Direction that comes out of the surfaces that meet in a place. It has a component of one along
/// that normal which it is furthest from. Zero where they turn too far from each other for that.
[[nodiscard]] inline Vec3 outwards(std::span<const FaceCorner> corners) {
    Vec3 sum(0.0f);
    for (const FaceCorner& c : corners) sum += c.normal;
    const float length = glm::length(sum);
    if (!(length > 0.0f)) return Vec3(0.0f);
    const Vec3 mean = sum / length;
    float least = 1.0f;
    for (const FaceCorner& c : corners) least = smaller(least, glm::dot(mean, c.normal));
    return least > 0.5f ? mean / least : Vec3(0.0f);
}

/// Where the corners of lifted faces lie, in the order of their triangles' corners. `step` metres a
/// level before the lamp. Faces of one level that meet in a corner still meet there, unless they
/// turn by more than 120 degrees.
[[nodiscard]] inline std::vector<std::array<Vec3, 3>> lifted_corners(
    const GeometryView<Space::host>& geometry, const std::vector<LampFace>& faces, float step) {
    std::vector<FaceCorner> all;
    all.reserve(3 * faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const auto& [triangle, front, level] = faces[i];
        const Vec3 normal = geometry.front_normal(triangle);
        for (std::uint32_t k = 0; k < 3; ++k)
            all.push_back(
                {geometry.corner(triangle, k), level, front, i, k, front ? normal : -normal});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.key() < b.key(); });
    std::vector<std::array<Vec3, 3>> lifted(faces.size());
    for (auto first = all.begin(); first != all.end();) {
        const auto last =
            std::find_if(first, all.end(), [&](const auto& c) { return c.key() != first->key(); });
        const Vec3 out = outwards({first, last});
        for (; first != last; ++first)
            lifted[first->face][first->corner] =
                first->place + (static_cast<float>(first->level) * step) *
                                   (out == Vec3(0.0f) ? first->normal : out);
    }
    return lifted;
}

}  // namespace mir::detail
