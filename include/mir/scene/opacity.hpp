// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/alpha_mask.hpp"
#include "mir/scene/crossing_number.hpp"
#include "mir/scene/see_through.hpp"
#include "mir/scene/textured_factors.hpp"

namespace mir {

/// What of a material says how much light goes straight through it. Plain values that kernels read.
struct SeeThrough {
    MaterialFactors factors{};  ///< what textures multiply
    float alpha = 1.0f;         ///< 0..1; read where it is blended
    bool is_blended = false;    ///< alpha is the covered share
    bool is_set = false;        ///< false: nothing goes through
    MaterialTextures own{};     ///< those that say how much goes through, and no other

    /// Luminance of straight_transmittance() at a point with these attributes.
    template <Space S>
    [[nodiscard]] MIR_HD float transmittance(const TextureView<S>& textures,
                                             const VertexAttributes& at, float cosine) const {
        const float covered =
            is_blended ? covered_share(alpha, own.base_color, textures, at) : 1.0f;
        const MaterialFactors there = textured_factors(factors, own, textures, at);
        return luminance(straight_transmittance(there, covered, cosine));
    }
};

template <Space S>
struct SegmentOpacity;

/// What kernels read of surfaces that do not stop all light: those with holes (AlphaMask) and those
/// that are seen through (SeeThrough). Closest hits ask masks() which points are there; a surface
/// that is seen through is. Segments between two points ask between(). A view; thread-safe.
template <Space S>
struct OpacityView {
    static constexpr Space space = S;  ///< where the arrays lie
    using Masks = AlphaMaskView<S>;    ///< what closest hits ask

    GeometryView<S> geometry;                 ///< of the triangles
    const AlphaMask* holes = nullptr;         ///< by material; nullptr: no triangle has a mask
    const SeeThrough* see_through = nullptr;  ///< by material; nullptr: none is seen through
    TextureView<S> textures{};                ///< of both

    /// False when every triangle stops all light.
    [[nodiscard]] MIR_HD bool exists() const { return holes != nullptr || see_through != nullptr; }
    /// The holes alone.
    [[nodiscard]] MIR_HD AlphaMaskView<S> masks() const { return {geometry, holes, textures}; }
    /// True for a triangle that stops all light.
    [[nodiscard]] MIR_HD bool stops_all(std::uint32_t triangle) const {
        if (!exists()) return true;
        const std::uint32_t material = geometry.materials[triangle];
        return (holes == nullptr || !holes[material].is_set()) &&
               (see_through == nullptr || !see_through[material].is_set);
    }
    /// What hides the points `a` and `b`, metres, from each other. This must outlive it.
    [[nodiscard]] MIR_HD SegmentOpacity<S> between(Vec3 a, Vec3 b) const { return {*this, a, b}; }
};

/// What stops the light between two points. Of light that a surface passes in part, each segment
/// gets all or nothing: by its crossing_number(), with the transmittance as the chance. So one bit
/// per segment is right in the mean, the same for every engine, backend and order.
template <Space S>
struct SegmentOpacity {
    const OpacityView<S>& surfaces;  ///< outlives this
    Vec3 a{0};                       ///< one end, metres
    Vec3 b{0};                       ///< the other

    /// False when is_solid() is true everywhere and need not be asked.
    [[nodiscard]] MIR_HD bool exists() const { return surfaces.exists(); }

    /// True when a triangle stops the segment, which crosses it at these barycentrics.
    [[nodiscard]] MIR_HD bool is_solid(std::uint32_t triangle, Vec2 barycentrics) const {
        if (!surfaces.masks().is_solid(triangle, barycentrics)) return false;
        if (surfaces.see_through == nullptr) return true;
        const SeeThrough& material = surfaces.see_through[surfaces.geometry.materials[triangle]];
        if (!material.is_set) return true;
        const float open = material.transmittance(
            surfaces.textures, surfaces.geometry.attributes(triangle, barycentrics),
            cosine_to(triangle));
        return !(crossing_number(a, b, triangle) < open);
    }

    /// Cosine of the angle between the segment and the triangle's normal, not negative.
    [[nodiscard]] MIR_HD float cosine_to(std::uint32_t triangle) const {
        const Vec3 d = b - a;
        return fabsf(glm::dot(d, surfaces.geometry.front_normal(triangle))) / glm::length(d);
    }
};

}  // namespace mir
