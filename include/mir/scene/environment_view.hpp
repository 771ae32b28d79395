// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/circle_turns.hpp"
#include "mir/core/discrete_distribution_2d.hpp"
#include "mir/core/rgb.hpp"
#include "mir/core/unit_circle.hpp"

namespace mir {

/// A direction towards an environment.
struct EnvironmentSample {
    Vec3 direction{0, 1, 0};  ///< unit, away from the scene
    Rgb radiance;             ///< W m^-2 sr^-1
    float pdf = 0.0f;         ///< of this direction, sr^-1
};

/// What kernels read of an EnvironmentTable. A view; thread-safe.
///
/// Directions are drawn in proportion to the luminance of their texel and uniformly inside it, so
/// their density is luminance / total per steradian, exactly, where total = int luminance dw: an
/// importance table whose weights are luminance times solid angle. Source: Pharr, Jakob, Humphreys,
/// "Physically Based Rendering", 3rd edition, section 14.2.4, except for the place inside the
/// texel.
template <Space S>
struct EnvironmentView {
    static constexpr Space space = S;  ///< where the arrays lie

    const Rgb* texels = nullptr;                 ///< scaled, rows from the top
    std::uint32_t width = 0;                     ///< columns of the image; 0: there is none
    std::uint32_t height = 0;                    ///< rows of the image
    float turns = 0.0f;                          ///< rotation about +y in whole turns, [0, 1)
    std::uint16_t light_group = 0;               ///< group that its light is counted in
    DiscreteDistribution2dView<S> by_luminance;  ///< picks texels; EnvironmentTable::by_luminance()

    /// True when no light comes from it: there is none, or it is black.
    [[nodiscard]] MIR_HD bool empty() const { return by_luminance.empty(); }

    /// int luminance dw over all directions, W m^-2.
    [[nodiscard]] MIR_HD double total() const { return by_luminance.rows.total; }

    /// Direction for `u` in [0, 1)^2. Must not be empty().
    [[nodiscard]] MIR_HD EnvironmentSample sample(Vec2 u) const {
        const GridCell cell = by_luminance.sample(u);
        const Rgb light = texels[static_cast<std::size_t>(cell.y) * width + cell.x];
        return {direction(cell), light, density(light)};
    }

    /// What comes from the unit direction `w`, W m^-2 sr^-1.
    [[nodiscard]] MIR_HD Rgb radiance(Vec3 w) const {
        return width == 0 ? Rgb{} : texels[texel_of(w)];
    }

    /// The numbers for which sample() gives the unit direction `w`, where it can: its texel is not
    /// black.
    [[nodiscard]] MIR_HD Vec2 numbers(Vec3 w) const {
        const Vec2 at = place_of(w);
        const std::uint32_t x = index(at.x, width);
        const std::uint32_t y = index(at.y, height);
        // Uniform by solid angle inside the texel.
        const Vec2 above = edge(y);
        const Vec2 below = edge(y + 1);
        const float s2 = 0.5f * (1.0f - w.y);
        const float inside = (s2 - above.y * above.y) / (below.y * below.y - above.y * above.y);
        return by_luminance.numbers(
            {x, y, {at.x * static_cast<float>(width) - static_cast<float>(x), inside}});
    }

    /// Density with which sample() draws the direction of something with this radiance, sr^-1.
    [[nodiscard]] MIR_HD float density(Rgb light) const {
        return static_cast<float>(static_cast<double>(luminance(light)) / total());
    }

 private:
    /// Cosine and sine of half the angle between +y and row `y`'s upper edge. Of the half angle,
    /// because texels at the poles would drown in the rounding of a cosine next to 1.
    [[nodiscard]] MIR_HD Vec2 edge(std::uint32_t y) const {
        return unit_circle(static_cast<float>(y) / (4.0f * static_cast<float>(height)));
    }

    /// Uniform by solid angle inside the cell: sin^2 of the half angle is.
    [[nodiscard]] MIR_HD Vec3 direction(const GridCell& cell) const {
        const Vec2 above = edge(cell.y);
        const Vec2 below = edge(cell.y + 1);
        const float t = cell.inside.y;
        const float c2 = (1.0f - t) * above.x * above.x + t * below.x * below.x;
        const float s2 = (1.0f - t) * above.y * above.y + t * below.y * below.y;
        const float sine = 2.0f * sqrtf(c2 * s2);
        const float column =
            (static_cast<float>(cell.x) + cell.inside.x) / static_cast<float>(width);
        const Vec2 around = unit_circle(column - 0.5f - turns);
        return {sine * around.x, c2 - s2, sine * around.y};
    }

    /// Where the image shows a direction: its left and upper edges are 0, the others 1.
    [[nodiscard]] MIR_HD Vec2 place_of(Vec3 w) const {
        const float azimuth = circle_turns({w.x, w.z}) + 0.5f + turns;
        return {azimuth - floorf(azimuth),
                2.0f * circle_turns({w.y, sqrtf(w.x * w.x + w.z * w.z)})};
    }
    [[nodiscard]] MIR_HD std::size_t texel_of(Vec3 w) const {
        const Vec2 at = place_of(w);
        return static_cast<std::size_t>(index(at.y, height)) * width + index(at.x, width);
    }
    MIR_HD static std::uint32_t index(float place, std::uint32_t count) {
        const auto i = static_cast<std::uint32_t>(place * static_cast<float>(count));
        return i < count ? i : count - 1;
    }
};

}  // namespace mir
