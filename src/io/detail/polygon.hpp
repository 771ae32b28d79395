// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/check_input.hpp"
#include "mir/scene/mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mir::detail {

/// Cuts polygons into triangles. Corners are counted as they are given. Not thread-safe: it keeps
/// its memory between polygons.
/// Source: ear clipping, Meisters, "Polygons have ears", American Mathematical Monthly 82, 1975.
class PolygonCutter {
 public:
    /// Corners that a polygon with a dent may have: the work grows with their square.
    static constexpr std::size_t most_corners = 4096;

    /// The triangles of a polygon, turning as it does; always two fewer than corners. A convex
    /// polygon becomes a fan, another is cut in the plane that suits it best. One that crosses or
    /// touches itself has no right answer: it is cut as far as it has ears, the rest as a fan.
    /// @pre three corners at least, all finite; no more than most_corners unless is_convex().
    [[nodiscard]] const std::vector<TriangleIndices>& cut(std::span<const Vec3> corners);

    /// True when every corner turns the same way as the whole.
    [[nodiscard]] bool is_convex(std::span<const Vec3> corners);

 private:
    using Point = glm::dvec2;

    /// Twice the signed area of a triangle.
    static double turn(Point a, Point b, Point c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    }
    [[nodiscard]] std::size_t next(std::size_t i, std::size_t step = 1) const {
        return (i + step) % left_.size();
    }
    void project(std::span<const Vec3> corners);
    [[nodiscard]] bool is_ear(std::size_t at) const;

    std::vector<Point> plane_;         ///< corners as seen from where they turn left
    std::vector<std::uint32_t> left_;  ///< corners that are not cut off yet, in order
    std::vector<TriangleIndices> triangles_;
};

/// Drops the coordinate along which the polygon's area is largest (Newell's normal).
inline void PolygonCutter::project(std::span<const Vec3> corners) {
    const glm::dvec3 origin(corners[0]);
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += glm::cross(glm::dvec3(corners[i]) - origin,
                             glm::dvec3(corners[(i + 1) % corners.size()]) - origin);
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const double flip = normal[axis] < 0.0 ? -1.0 : 1.0;
    plane_.clear();
    for (const Vec3& p : corners) plane_.emplace_back(flip * double{p[u]}, double{p[v]});
}

inline bool PolygonCutter::is_convex(std::span<const Vec3> corners) {
    project(corners);
    // A star turns one way everywhere and yet crosses itself: it goes round more than once.
    std::size_t changes = 0;
    const std::size_t n = plane_.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Point a = plane_[i];
        const Point b = plane_[(i + 1) % n];
        const Point c = plane_[(i + 2) % n];
        if (turn(a, b, c) < 0.0) return false;
        if ((b.x > a.x) != (c.x > b.x)) ++changes;
    }
    return changes <= 2;
}

inline bool PolygonCutter::is_ear(std::size_t at) const {
    const std::uint32_t corner[3] = {left_[at], left_[next(at)], left_[next(at, 2)]};
    const Point a = plane_[corner[0]];
    const Point b = plane_[corner[1]];
    const Point c = plane_[corner[2]];
    if (!(turn(a, b, c) > 0.0)) return false;
    for (std::size_t k = 3; k < left_.size(); ++k) {
        const Point p = plane_[left_[next(at, k)]];
        // Corners given twice, as where a hole is tied to the outline, hide nothing.
        if (p == a || p == b || p == c) continue;
        if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
    }
    return true;
}

inline const std::vector<TriangleIndices>& PolygonCutter::cut(std::span<const Vec3> corners) {
    triangles_.clear();
    left_.resize(corners.size());
    for (std::size_t i = 0; i < left_.size(); ++i) left_[i] = static_cast<std::uint32_t>(i);
    if (left_.size() > 3 && !is_convex(corners)) {
        std::size_t at = 0;
        for (std::size_t tried = 0; left_.size() > 3 && tried < left_.size();) {
            if (!is_ear(at)) {
                at = next(at);
                ++tried;
                continue;
            }
            triangles_.push_back({left_[at], left_[next(at)], left_[next(at, 2)]});
            const std::size_t tip = next(at);
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(tip));
            // The corner before may have become an ear.
            at = (tip < at ? at - 1 : at) % left_.size();
            at = (at + left_.size() - 1) % left_.size();
            tried = 0;
        }
    }
    for (std::size_t i = 2; i < left_.size(); ++i)
        triangles_.push_back({left_[0], left_[i - 1], left_[i]});
    return triangles_;
}

/// The triangles of a polygon of a file.
/// @throws Error(invalid_input) when it has a dent and more corners than can be cut in due time.
inline const std::vector<TriangleIndices>& cut_polygon(PolygonCutter& cutter,
                                                       std::span<const Vec3> corners,
                                                       const std::string& place) {
    constexpr std::size_t most = PolygonCutter::most_corners;
    if (corners.size() > most && !cutter.is_convex(corners))
        fail_at(place, "a face with a dent has " + std::to_string(corners.size()) +
                           " corners (at most " + std::to_string(most) +
                           " are cut into triangles); export triangles");
    return cutter.cut(corners);
}

}  // namespace mir::detail
