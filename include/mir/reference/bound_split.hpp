// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/luxel.hpp"
#include "mir/shading/vpl_shading.hpp"

#include <cmath>
#include <limits>

namespace mir {

/// Which part of the light on the first edge of a path is wanted.
enum class BoundPart {
    kept,    ///< min(G, bound) / G of it: what VplShading gives
    removed  ///< max(G - bound, 0) / G of it: what RemovedByBound tells
};

/// How a bound splits the light that reaches a path's first vertex. It bounds the geometry term.
/// The two parts of one bound add up to all light. Thread-safe.
struct BoundSplit {
    float bound = std::numeric_limits<float>::max();  ///< m^-2
    BoundPart part = BoundPart::kept;                 ///< which of the two is wanted
    bool lamps = false;  ///< the bound holds for the emission of triangles too

    /// Share of the light that `at` gets from `from` when they see each other, 0..1. `at` is a
    /// lifted point with unit shading normal `normal`, `from` a reflecting point, also lifted.
    /// Nearer to an edge than points are lifted they may not face each other: no VPL there lights
    /// `at`.
    [[nodiscard]] MIR_HD float reflected(const Hit& at, Vec3 normal, const Hit& from) const {
        const Vec3 d = from.position - at.position;
        const float d2 = length_squared(d);
        const float inverse = 1.0f / std::sqrt(d2);
        const float g = geometry_term(d * inverse, inverse, normal, from.normal);
        const bool is_near = d2 * bound < glm::dot(d * inverse, normal);
        const float kept = g > bound ? bound / g : is_near && !(g > 0.0f) ? 0.0f : 1.0f;
        return part == BoundPart::kept ? kept : 1.0f - kept;
    }

    /// The same of the emission of `from`.
    [[nodiscard]] MIR_HD float emitted(const Hit& at, Vec3 normal, const Hit& from) const {
        return lamps ? reflected(at, normal, from) : unbounded();
    }

    /// Share of light that no bound holds for: emission seen directly, lights without extent.
    [[nodiscard]] MIR_HD float unbounded() const { return part == BoundPart::kept ? 1.0f : 0.0f; }

    /// Largest distance from a point at which anything counts, m. It is seen at `cosine` to the
    /// shading normal: G <= cos / d^2.
    [[nodiscard]] MIR_HD float reach(float cosine) const {
        return part == BoundPart::kept ? INFINITY : std::sqrt(cosine / bound);
    }
};

}  // namespace mir
