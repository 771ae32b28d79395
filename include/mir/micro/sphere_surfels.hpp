// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/double3.hpp"
#include "mir/core/limits.hpp"
#include "mir/micro/surfel.hpp"
#include "mir/micro/surfel_options.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mir {

namespace detail {

/// How the surface of a sphere is cut. Rows between parallels of equal distance, each into equal
/// patches between meridians that are about as wide as high.
struct SpherePatches {
    static constexpr double half_turn = 3.14159265358979323846;

    double radius;
    std::uint32_t rows;

    SpherePatches(float r, float max_area)
        : radius(r), rows(parts(half_turn * radius, std::sqrt(static_cast<double>(max_area)))) {}

    /// Angle of the upper border of a row, from the pole.
    [[nodiscard]] double angle(std::uint32_t row) const { return half_turn * row / rows; }
    [[nodiscard]] std::uint32_t columns(std::uint32_t row, float max_area) const {
        return parts(row_area(row), static_cast<double>(max_area));
    }
    /// m^2; over all rows 4 pi r^2 (Archimedes).
    [[nodiscard]] double row_area(std::uint32_t row) const {
        return 2.0 * half_turn * radius * radius *
               (std::cos(angle(row)) - std::cos(angle(row + 1)));
    }

    /// Unit vector at a part of a turn from the first meridian. It lies halfway between a row's
    /// borders.
    [[nodiscard]] Double3 middle(std::uint32_t row, double turn) const {
        return on_sphere(angle(row) + 0.5 * half_turn / rows, 2.0 * half_turn * turn);
    }

    /// Metres: as large as a patch, or to its farthest corner.
    [[nodiscard]] float disc_radius(std::uint32_t row, std::uint32_t columns,
                                    DiscExtent extent) const {
        if (extent == DiscExtent::equal_area)
            return static_cast<float>(std::sqrt(row_area(row) / columns / half_turn));
        const double half_width = half_turn / columns;
        const Double3 from = middle(row, 0.0);
        const double reach = std::max(glm::distance(from, on_sphere(angle(row), half_width)),
                                      glm::distance(from, on_sphere(angle(row + 1), half_width)));
        return static_cast<float>(radius * reach * (1.0 + 1e-6));
    }

    static Double3 on_sphere(double polar, double turn) {
        return {std::sin(polar) * std::cos(turn), std::cos(polar),
                std::sin(polar) * std::sin(turn)};
    }

    /// Fewest equal parts of `whole` that are no larger than `most`.
    static std::uint32_t parts(double whole, double most) {
        return static_cast<std::uint32_t>(std::max(1.0, std::ceil(whole / most)));
    }
};

}  // namespace detail

/// Cuts a sphere into patches of at most options.max_area, with a disc in each. Patches lie between
/// parallels and meridians and are about as wide as high. A disc touches the sphere in the middle
/// of the patch, its front outside. It is as large as the patch (DiscExtent::equal_area) or reaches
/// to its farthest corner (others; patches have no straight edges to end at). Areas add up to that
/// of the sphere, except for the rounding of each to single precision. `material` is an index as of
/// WorldGeometry::material_of(); the discs belong to Surfel::no_triangle.
/// @throws Error(invalid_argument) on options or a radius out of range; Error(limit_exceeded)
///         before memory is taken.
inline std::vector<Surfel> sphere_surfels(Vec3 centre, float radius, std::uint32_t material,
                                          const SurfelOptions& options, const Limits& limits) {
    check(options);
    expects(radius > 0.0f && std::isfinite(radius),
            "the radius of a sphere must be positive and finite (metres), or it has no surface; "
            "give one");
    // Before rows are counted by 32 bits: patches are at least a quarter as large as asked for,
    // except at the poles.
    check_limit(static_cast<std::uint64_t>(
                    std::min(1e18, 12.0 * static_cast<double>(radius) * radius / options.max_area)),
                limits.surfels, "surfels");
    const detail::SpherePatches patches(radius, options.max_area);
    std::vector<Surfel> surfels;
    for (std::uint32_t row = 0; row < patches.rows; ++row) {
        const std::uint32_t columns = patches.columns(row, options.max_area);
        check_limit(surfels.size() + columns, limits.surfels, "surfels");
        Surfel s;
        s.radius = patches.disc_radius(row, columns, options.extent);
        s.area = static_cast<float>(patches.row_area(row) / columns);
        s.triangle = Surfel::no_triangle;
        s.material = material;
        for (std::uint32_t column = 0; column < columns; ++column) {
            const detail::Double3 n = patches.middle(row, (column + 0.5) / columns);
            s.position = Vec3(detail::Double3(centre) + patches.radius * n);
            s.normal = Vec3(n);
            surfels.push_back(s);
        }
    }
    return surfels;
}

}  // namespace mir
