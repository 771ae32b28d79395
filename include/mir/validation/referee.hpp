// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/double3.hpp"
#include "mir/scene/world_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace mir::validation {

/// Where the line origin + t direction meets the plane of a triangle.
struct LineHit {
    double t = 0.0;  ///< place on the line, in lengths of `direction`
    double u = 0.0;  ///< weight of the triangle's second vertex
    double v = 0.0;  ///< weight of its third

    /// How far inside the triangle the point lies, in barycentric units; negative outside.
    [[nodiscard]] double inside() const { return std::min(std::min(u, v), 1.0 - u - v); }
};

/// Brute force in double precision: what fast visibility and ray casters are judged by. Source:
/// Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", JGT 2(1), 1997.
class Referee {
 public:
    /// A vector of doubles: products of coordinates round far below single precision.
    using Double3 = mir::detail::Double3;

    /// The geometry must outlive it. closest() does not look at masks.
    explicit Referee(const WorldGeometry& geometry) : geometry_(&geometry) {}

    /// Answer to "is a hidden from b", with the margin by which it holds.
    struct Verdict {
        /// Positive where the segment is hidden, negative where it is visible. Hidden: the deepest
        /// cut lies that far from the edges of its triangle and from the ends of the segment (both
        /// in units of their length). Visible: every triangle is missed by at least that much.
        /// Negative: visible, and every triangle is missed by at least that much.
        double margin = -std::numeric_limits<double>::infinity();

        /// True when nothing lies on the segment.
        [[nodiscard]] bool visible() const { return margin < 0.0; }
        /// Single precision cannot be expected to know.
        [[nodiscard]] bool doubtful(double below) const { return std::fabs(margin) < below; }
    };

    /// Judges the closed segment from a to b, leaving out the triangles `skip` and `skip_too`. What
    /// is not opaque hides what WorldGeometry::opacity() says; near where that changes the margin
    /// is 0.
    [[nodiscard]] Verdict segment(Vec3 a, Vec3 b, std::uint32_t skip = none,
                                  std::uint32_t skip_too = none) const {
        Verdict verdict;
        const Double3 origin(a);
        const Double3 direction = Double3(b) - origin;
        const OpacityView<Space::host> surfaces = geometry_->opacity();
        for (std::uint32_t i = 0; i < geometry_->triangles().size(); ++i) {
            if (i == skip || i == skip_too) continue;
            const auto hit = line(i, origin, direction);
            if (!hit) continue;
            const double along = std::min(hit->t, 1.0 - hit->t);
            const double depth = std::min(hit->inside(), along);
            verdict.margin = std::max(
                verdict.margin,
                surfaces.stops_all(i) ? depth : margin_of(surfaces.between(a, b), i, *hit, depth));
        }
        return verdict;
    }

    /// The first triangle along a ray.
    struct Closest {
        std::uint32_t triangle = none;  ///< index into WorldGeometry; none: the ray meets nothing
        LineHit hit;                    ///< where it is met; t is in metres
        /// Distance in barycentric units from the closest decision that could differ. That is an
        /// edge of this triangle or of one before it.
        double margin = std::numeric_limits<double>::infinity();
        double runner_up = std::numeric_limits<double>::infinity();  ///< t of the second triangle
    };

    /// Asks all triangles, in their order; of equally near ones the first is taken.
    [[nodiscard]] Closest closest(const Ray& ray) const {
        Closest best;
        best.hit.t = std::numeric_limits<double>::infinity();
        const Double3 origin(ray.origin);
        const Double3 direction(ray.direction);
        for (std::uint32_t i = 0; i < geometry_->triangles().size(); ++i) {
            const auto hit = line(i, origin, direction);
            if (!hit || hit->t <= 0.0) continue;
            best.margin = std::min(best.margin, std::fabs(hit->inside()));
            if (hit->inside() < 0.0) continue;
            if (hit->t < best.hit.t) {
                best.runner_up = best.hit.t;
                best.hit = *hit;
                best.triangle = i;
            } else {
                best.runner_up = std::min(best.runner_up, hit->t);
            }
        }
        return best;
    }

    static constexpr std::uint32_t none = 0xFFFFFFFFu;  ///< no triangle

    /// Where a line meets the plane of triangle `i`; nothing when they are parallel.
    [[nodiscard]] std::optional<LineHit> line(std::uint32_t i, Double3 origin,
                                              Double3 direction) const {
        const Double3 a(geometry_->corner(i, 0));
        const Double3 e1 = Double3(geometry_->corner(i, 1)) - a;
        const Double3 e2 = Double3(geometry_->corner(i, 2)) - a;
        const Double3 p = glm::cross(direction, e2);
        const double det = glm::dot(e1, p);
        if (det == 0.0) return std::nullopt;
        const Double3 from_corner = origin - a;
        const Double3 q = glm::cross(from_corner, e1);
        return LineHit{glm::dot(e2, q) / det, glm::dot(from_corner, p) / det,
                       glm::dot(direction, q) / det};
    }

 private:
    /// What a triangle that is not opaque adds to a verdict, if it is cut that deeply. Beside the
    /// hit it may hide something else.
    [[nodiscard]] static double margin_of(const SegmentOpacity<Space::host>& stops, std::uint32_t i,
                                          const LineHit& hit, double depth) {
        constexpr double beside = 1e-4;
        if (depth < -beside) return depth;
        int solid = 0;
        for (const auto& [du, dv] :
             {std::pair{0.0, 0.0}, {beside, 0.0}, {-beside, 0.0}, {0.0, beside}, {0.0, -beside}})
            solid += stops.is_solid(i, {hit.u + du, hit.v + dv}) ? 1 : 0;
        if (solid == 0) return -std::numeric_limits<double>::infinity();
        return solid == 5 ? depth : std::min(depth, 0.0);
    }

    const WorldGeometry* geometry_;
};

}  // namespace mir::validation
