// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/bounds.hpp"
#include "mir/scene/lights/light_cone.hpp"

namespace mir {

/// Bounds of what some lamps send out: where they are, into what directions, how much.
struct LightBounds {
    Bounds box;          ///< of their places, metres
    LightCone cone;      ///< of their directions
    double power = 0.0;  ///< sum of the luminances of their power, W; positive

    /// Bounds of both.
    [[nodiscard]] LightBounds with(const LightBounds& other) const {
        if (box.empty()) return other;
        if (other.box.empty()) return *this;
        LightBounds sum{box, cone.with(other.cone), power + other.power};
        sum.box.add(other.box.low);
        sum.box.add(other.box.high);
        return sum;
    }

    /// The term of one child in the surface area orientation heuristic, M_A M_Omega E. M_A is the
    /// square of the diagonal, because lamps without extent on a line have no surface.
    [[nodiscard]] double cost() const {
        const double size = box.diagonal();
        return size * size * cone.measure() * power;
    }
};

}  // namespace mir
