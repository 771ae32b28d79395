// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/double3.hpp"
#include "mir/core/limits.hpp"
#include "mir/micro/surfel.hpp"
#include "mir/micro/surfel_options.hpp"
#include "mir/scene/world_geometry.hpp"

#include <algorithm>

namespace mir::detail {

/// Place of a piece in the triangular lattice of its level. Its first corner, in steps along the
/// edges to the triangle's second and third corner, and whether it points like the triangle (1) or
/// the other way (-1).
struct PiecePlace {
    std::int64_t i = 0;
    std::int64_t j = 0;
    std::int64_t sign = 1;
};

/// Piece `index` of 4^level. Its digits to base 4, the highest first, say into which part of its
/// parent it goes. Parts 0 to 2 touch the parent's corners, 3 lies in the middle.
inline PiecePlace piece_place(std::uint64_t index, std::uint32_t level) {
    PiecePlace p;
    for (std::uint32_t k = level; k-- > 0;) {
        const std::uint64_t part = index >> 2 * k & 3;
        p.i = 2 * p.i + (part == 1 || part == 3 ? p.sign : 0);
        p.j = 2 * p.j + (part == 2 || part == 3 ? p.sign : 0);
        if (part == 3) p.sign = -p.sign;
    }
    return p;
}

/// The piece of 4^level that a point of the triangle lies in. `b` are the weights of the second and
/// third corner. Inverse of piece_place().
inline std::uint64_t piece_at(Vec2 b, std::uint32_t level) {
    std::uint64_t index = 0;
    for (std::uint32_t k = 0; k < level; ++k) {
        std::uint64_t part = 3;
        if (1.0f - b.x - b.y >= 0.5f)
            part = 0, b = 2.0f * b;
        else if (b.x >= 0.5f)
            part = 1, b = 2.0f * b - Vec2(1.0f, 0.0f);
        else if (b.y >= 0.5f)
            part = 2, b = 2.0f * b - Vec2(0.0f, 1.0f);
        else
            b = Vec2(1.0f) - 2.0f * b;
        index = 4 * index + part;
    }
    return index;
}

/// Weights of a triangle's second and third corner at a point of its plane.
inline Vec2 barycentrics_at(const WorldGeometry& geometry, std::uint32_t triangle, Double3 point) {
    const Double3 a(geometry.corner(triangle, 0));
    const Double3 first = Double3(geometry.corner(triangle, 1)) - a;
    const Double3 second = Double3(geometry.corner(triangle, 2)) - a;
    const Double3 normal = glm::cross(first, second);
    const double area2 = glm::dot(normal, normal);
    return {glm::dot(glm::cross(point - a, second), normal) / area2,
            glm::dot(glm::cross(first, point - a), normal) / area2};
}

/// A triangle as its pieces want it. Computed in double precision, so that needles and scenes far
/// from the origin lose nothing.
struct TrianglePieces {
    Double3 corner{0};
    Double3 edge1{0};
    Double3 edge2{0};
    Vec3 normal{0, 0, 1};
    float area = 0.0f;        ///< of one piece, m^2
    float radius = 0.0f;      ///< metres
    std::uint32_t level = 0;  ///< times that the triangle is cut in four
    std::uint64_t count = 0;  ///< 4^level, at most 2^62
    Vec3 corner1{0};          ///< from the centroid of a piece that points like the triangle;
    Vec3 corner2{0};          ///< zero: discs are whole

    /// Of all pieces together, exactly; m^2.
    [[nodiscard]] float whole_area() const { return std::ldexp(area, 2 * static_cast<int>(level)); }

    /// Disc of piece `index` of triangle `triangle`.
    [[nodiscard]] Surfel disc(std::uint64_t index, std::uint32_t triangle,
                              std::uint32_t material) const {
        const PiecePlace p = piece_place(index, level);
        const double scale = 3.0 * static_cast<double>(std::uint64_t{1} << level);
        const Vec3 centre{corner + static_cast<double>(3 * p.i + p.sign) / scale * edge1 +
                          static_cast<double>(3 * p.j + p.sign) / scale * edge2};
        const auto sign = static_cast<float>(p.sign);
        return {centre, radius, normal, area, triangle, material, sign * corner1, sign * corner2};
    }
};

/// @throws Error(invalid_input) when the area is no number of single precision.
inline TrianglePieces pieces_of(const WorldGeometry& geometry, std::uint32_t triangle,
                                const SurfelOptions& options) {
    TrianglePieces p;
    p.corner = Double3(geometry.corner(triangle, 0));
    p.edge1 = Double3(geometry.corner(triangle, 1)) - p.corner;
    p.edge2 = Double3(geometry.corner(triangle, 2)) - p.corner;
    const Double3 cross = glm::cross(p.edge1, p.edge2);
    const double twice = glm::length(cross);
    p.normal = Vec3(cross / twice);
    p.area = static_cast<float>(0.5 * twice);
    if (!std::isfinite(p.area) || !(p.area > 0.0f))
        throw Error(ErrorCode::invalid_input,
                    "triangle " + std::to_string(triangle) +
                        " has an area that single precision cannot hold (discs could not share "
                        "it); scale the scene");
    // A quarter is exact: the areas of all pieces add up to that of the triangle.
    while (p.area > options.max_area) {
        p.area *= 0.25f;
        ++p.level;
    }
    p.count = std::uint64_t{1} << std::min(2 * p.level, 62u);
    const Double3 centroid = (p.edge1 + p.edge2) / 3.0;
    const double farthest = std::max(
        {glm::length(centroid), glm::length(p.edge1 - centroid), glm::length(p.edge2 - centroid)});
    const double cover = std::ldexp(farthest, -static_cast<int>(p.level));
    const double equal = std::sqrt(static_cast<double>(p.area) / 3.14159265358979323846);
    p.radius = static_cast<float>(options.extent == DiscExtent::equal_area ? equal : cover);
    if (options.extent == DiscExtent::piece) {
        const double scale = std::ldexp(1.0, -static_cast<int>(p.level));
        p.corner1 = Vec3(scale * (p.edge1 - centroid));
        p.corner2 = Vec3(scale * (p.edge2 - centroid));
    }
    return p;
}

}  // namespace mir::detail
