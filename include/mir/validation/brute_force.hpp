// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/ray_caster.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/validation/referee.hpp"

namespace mir::validation {

/// Visibility by asking the referee, in double precision. Model of Visibility and PacketVisibility.
struct BruteForceVisibility {
    static constexpr Space space = Space::host;  ///< where the geometry is

    Referee referee;  ///< of the geometry

    /// True when no triangle hides the points (metres) from each other.
    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const { return referee.segment(a, b).visible(); }
    /// As PacketVisibility says, bit k being visible(origin, point k).
    [[nodiscard]] std::uint32_t visible_packet(Vec3 origin, const PointPacket& points,
                                               std::uint32_t active) const {
        std::uint32_t seen = 0;
        for (std::uint32_t k = 0; k < PointPacket::width; ++k)
            if ((active >> k & 1u) != 0 && visible(origin, {points.x[k], points.y[k], points.z[k]}))
                seen |= 1u << k;
        return seen;
    }
};

/// Model of RayCaster by asking the referee. Safe from any thread.
struct BruteForceRayCaster {
    const WorldGeometry* geometry = nullptr;  ///< must not be null when asked

    /// The first surface along the ray; none when it leaves the scene.
    [[nodiscard]] std::optional<SurfacePoint> closest_hit(Ray ray) const {
        const Referee::Closest found = Referee(*geometry).closest(ray);
        if (found.triangle == Referee::none) return std::nullopt;
        return geometry->surface_point(
            found.triangle, {static_cast<float>(found.hit.u), static_cast<float>(found.hit.v)},
            ray);
    }
};

/// A ray engine without acceleration structure, for checks of everything above ray tracing. Each
/// question takes time in proportion to the triangles. Safe from any thread. The geometry must
/// outlive it.
class BruteForceScene {
 public:
    /// Refers to the geometry; builds nothing.
    explicit BruteForceScene(const WorldGeometry& geometry) : geometry_(&geometry) {}

    /// Says whether two points see each other.
    [[nodiscard]] BruteForceVisibility visibility() const { return {Referee(*geometry_)}; }
    /// Finds what rays meet first.
    [[nodiscard]] BruteForceRayCaster ray_caster() const { return {geometry_}; }

 private:
    const WorldGeometry* geometry_;
};

static_assert(PacketVisibility<BruteForceVisibility>);
static_assert(RayCaster<BruteForceRayCaster>);

}  // namespace mir::validation
