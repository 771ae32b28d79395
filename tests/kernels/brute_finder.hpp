// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/find_surface.hpp"
#include "mir/accel/exact/reach.hpp"
#include "mir/accel/exact/triangle_rows.hpp"
#include "mir/concepts/ray_caster.hpp"
#include "mir/concepts/ray_finder.hpp"
#include "mir/scene/world_geometry.hpp"

#include <vector>

namespace mirtest {

/// The rows of all triangles of a scene.
inline std::vector<mir::TriangleRows> rows_of(const mir::WorldGeometry& g) {
    std::vector<mir::TriangleRows> rows;
    for (std::uint32_t t = 0; t < g.triangles().size(); ++t)
        rows.push_back(mir::make_triangle_rows(g.corner(t, 0), g.corner(t, 1), g.corner(t, 2)));
    return rows;
}

/// Model of RayFinder that asks every triangle. What it reads must outlive it.
struct BruteFinder {
    static constexpr mir::Space space = mir::Space::host;

    const mir::TriangleRows* rows = nullptr;
    std::uint32_t count = 0;
    float reach = 0.0f;

    [[nodiscard]] mir::TriangleHit closest(const mir::Ray& ray) const {
        mir::TriangleHit best;
        const mir::CutSegment cut = cut_to_reach(ray, reach);
        for (std::uint32_t t = 0; t < count && !cut.empty; ++t)
            keep_closer(rows[t], cut.from, cut.to, t, best);
        if (best.triangle != mir::TriangleHit::none) best.t = cut.t_from + best.t * cut.t_length;
        return best;
    }
    [[nodiscard]] bool hides(mir::Vec3 from, mir::Vec3 to) const {
        for (std::uint32_t t = 0; t < count; ++t)
            if (hits_segment(rows[t], from, to)) return true;
        return false;
    }
};
static_assert(mir::RayFinder<BruteFinder>);

/// What the same finder meets, as host code and kernels ask for it.
struct BruteFinderCaster {
    static constexpr mir::Space space = mir::Space::host;

    mir::GeometryView<mir::Space::host> geometry;
    BruteFinder finder;

    [[nodiscard]] bool find_point(const mir::Ray& ray, mir::SurfacePoint& point) const {
        return find_surface(finder, geometry, ray, point);
    }
    [[nodiscard]] std::optional<mir::SurfacePoint> closest_hit(mir::Ray ray) const {
        mir::SurfacePoint point;
        if (!find_point(ray, point)) return std::nullopt;
        return point;
    }
};
static_assert(mir::RayCaster<BruteFinderCaster> && mir::PointFinder<BruteFinderCaster>);

}  // namespace mirtest
