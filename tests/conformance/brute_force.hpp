// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/referee.hpp"
#include "mir/concepts/ray_caster.hpp"
#include "mir/concepts/visibility.hpp"

namespace mirtest {

/// Visibility by asking the referee. Model of Visibility and PacketVisibility.
struct BruteForceVisibility {
    static constexpr mir::Space space = mir::Space::host;

    Referee referee;

    [[nodiscard]] bool visible(mir::Vec3 a, mir::Vec3 b) const {
        return referee.segment(a, b).visible();
    }
    [[nodiscard]] std::uint32_t visible_packet(mir::Vec3 origin, const mir::PointPacket& points,
                                               std::uint32_t active) const {
        std::uint32_t seen = 0;
        for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k)
            if ((active >> k & 1u) != 0 && visible(origin, {points.x[k], points.y[k], points.z[k]}))
                seen |= 1u << k;
        return seen;
    }
};

/// Model of RayCaster by asking the referee.
struct BruteForceRayCaster {
    const mir::WorldGeometry* geometry = nullptr;

    [[nodiscard]] std::optional<mir::SurfacePoint> closest_hit(mir::Ray ray) const {
        const Referee::Closest found = Referee(*geometry).closest(ray);
        if (found.triangle == Referee::none) return std::nullopt;
        return geometry->surface_point(
            found.triangle, {static_cast<float>(found.hit.u), static_cast<float>(found.hit.v)},
            ray.direction);
    }
};

/// A ray engine without acceleration structure: tests of everything above ray tracing run on it
/// where no backend is built. The geometry must outlive it.
class BruteForceScene {
 public:
    explicit BruteForceScene(const mir::WorldGeometry& geometry) : geometry_(&geometry) {}

    [[nodiscard]] BruteForceVisibility visibility() const { return {Referee(*geometry_)}; }
    [[nodiscard]] BruteForceRayCaster ray_caster() const { return {geometry_}; }

 private:
    const mir::WorldGeometry* geometry_;
};

static_assert(mir::PacketVisibility<BruteForceVisibility>);
static_assert(mir::RayCaster<BruteForceRayCaster>);

}  // namespace mirtest
