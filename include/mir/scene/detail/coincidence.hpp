// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mir::detail {

using Corners = std::array<DVec3, 3>;
using FlatCorners = std::array<glm::dvec2, 3>;

/// A triangle with an area.
struct Facet {
    explicit Facet(const Corners& t)
        : corners(t), normal(glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]))) {}

    Corners corners;
    DVec3 normal;  ///< of the front, of length 1
};

/// True when no corner of `t` is further than `tolerance` from the plane of `other`.
[[nodiscard]] inline bool lies_in_plane(const Corners& t, const Facet& other, double tolerance) {
    return std::all_of(t.begin(), t.end(), [&](DVec3 corner) {
        return std::fabs(glm::dot(other.normal, corner - other.corners[0])) <= tolerance;
    });
}

/// The corners without the coordinate along which `normal` is longest.
[[nodiscard]] inline FlatCorners flattened(const Corners& t, DVec3 normal) {
    const DVec3 n = glm::abs(normal);
    const int dropped = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
    FlatCorners flat;
    for (std::size_t k = 0; k < 3; ++k)
        flat[k] = {t[k][(dropped + 1) % 3], t[k][(dropped + 2) % 3]};
    return flat;
}

/// Overlap of two triangles along the normal of the edge where it is least. The edge is one of `a`;
/// not positive when such an edge parts them.
[[nodiscard]] inline double overlap_across_edges(const FlatCorners& a, const FlatCorners& b) {
    double least = INFINITY;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 edge = a[(k + 1) % 3] - a[k];
        const glm::dvec2 normal = glm::dvec2(-edge.y, edge.x) / glm::length(edge);
        const auto extent = [&](const FlatCorners& t) {
            const auto [low, high] = std::minmax(
                {glm::dot(normal, t[0]), glm::dot(normal, t[1]), glm::dot(normal, t[2])});
            return glm::dvec2(low, high);
        };
        const glm::dvec2 of_a = extent(a);
        const glm::dvec2 of_b = extent(b);
        least = std::min(least, std::min(of_a.y, of_b.y) - std::max(of_a.x, of_b.x));
    }
    return least;
}

/// True when two triangles lie in one plane, to `tolerance`, metres, where they overlap. Triangles
/// that only share an edge or a corner do not.
/// Source: separating axes; Ericson, "Real-Time Collision Detection", 2005, 5.2.1.
[[nodiscard]] inline bool coincide(const Facet& a, const Facet& b, double tolerance) {
    if (!lies_in_plane(a.corners, b, tolerance) && !lies_in_plane(b.corners, a, tolerance))
        return false;
    const FlatCorners flat_a = flattened(a.corners, a.normal);
    const FlatCorners flat_b = flattened(b.corners, a.normal);
    return std::min(overlap_across_edges(flat_a, flat_b), overlap_across_edges(flat_b, flat_a)) >
           4.0 * tolerance;
}

}  // namespace mir::detail
