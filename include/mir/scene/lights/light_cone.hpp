// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <algorithm>
#include <cmath>

namespace mir {

/// Bounds of the directions into which lamps shine. Their normals lie within `spread` of `axis`,
/// and each shines up to `emission` away from its normal: theta_o and theta_e of Conty Estevez and
/// Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018.
struct LightCone {
    Vec3 axis{0, 0, 1};      ///< unit
    float spread = 0.0f;     ///< radians, 0..pi
    float emission = 0.0f;   ///< radians, 0..pi
    bool is_double = false;  ///< -axis as well as axis

    /// All directions.
    [[nodiscard]] static LightCone everywhere() { return {{0, 0, 1}, pi, 0.5f * pi, false}; }

    /// The same bounds without a second axis.
    [[nodiscard]] LightCone single() const {
        return is_double ? LightCone{axis, pi, emission, false} : *this;
    }

    /// The least cone around both. "Cone union" of the paper.
    [[nodiscard]] LightCone with(const LightCone& other) const {
        if (is_double != other.is_double) return single().with(other.single());
        if (other.spread > spread) return other.with(*this);
        LightCone sum = *this;
        sum.emission = std::max(emission, other.emission);
        const float cosine = std::clamp(glm::dot(axis, other.axis), -1.0f, 1.0f);
        const bool is_turned = is_double && cosine < 0.0f;
        const float between = std::acos(is_turned ? -cosine : cosine);
        if (std::min(between + other.spread, pi) <= spread) return sum;
        const Vec3 towards = other.axis * (is_turned ? -1.0f : 1.0f);
        const Vec3 across = towards - axis * glm::dot(axis, towards);
        const float length = glm::length(across);
        // Axes that are almost equal stay; opposite ones have no direction between them.
        const bool is_along = !(length > 1e-3f);
        sum.spread = is_along ? between + other.spread : 0.5f * (spread + between + other.spread);
        if (!(sum.spread < pi)) return {axis, pi, sum.emission, false};
        if (is_along) return sum;
        const float turn = sum.spread - spread;
        sum.axis = glm::normalize(axis * std::cos(turn) + across * (std::sin(turn) / length));
        return sum;
    }

    /// M_Omega of the paper: the solid angle that is lit, weighted by the cosine of its edge.
    [[nodiscard]] double measure() const {
        const double o = spread;
        const double w = std::min(o + static_cast<double>(emission), static_cast<double>(pi));
        const double edge =
            2.0 * w * std::sin(o) - std::cos(o - 2.0 * w) - 2.0 * o * std::sin(o) + std::cos(o);
        const double one = static_cast<double>(pi) * (2.0 * (1.0 - std::cos(o)) + 0.5 * edge);
        return is_double ? 2.0 * one : one;
    }
};

}  // namespace mir
