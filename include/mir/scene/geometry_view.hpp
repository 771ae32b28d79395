// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"
#include "mir/core/space.hpp"
#include "mir/core/strict_float.hpp"
#include "mir/data/vertex_attributes.hpp"
#include "mir/scene/mesh.hpp"

#include <cmath>

namespace mir {

/// What kernels read of a WorldGeometry. Turns the answers of ray engines (triangle, barycentrics)
/// into surface points, with the same bits on host and device. A view; thread-safe.
template <Space S>
struct GeometryView {
    static constexpr Space space = S;  ///< where the arrays lie

    const Vec3* positions = nullptr;             ///< of vertices, metres
    const Vec3* normals = nullptr;               ///< of vertices, unit; zero where there is none
    const TriangleIndices* triangles = nullptr;  ///< indices into positions
    const std::uint32_t* materials = nullptr;    ///< of triangles
    float ray_offset = 0.0f;                     ///< WorldGeometry::ray_offset(), metres
    const Vec2* texture_coordinates = nullptr;   ///< of vertices; nullptr: no mesh has any
    const Rgb* colors = nullptr;                 ///< of vertices; nullptr: all are white

    /// Corner `k` (0..2) of a triangle, metres.
    [[nodiscard]] MIR_HD Vec3 corner(std::uint32_t triangle, std::uint32_t k) const {
        return positions[triangles[triangle][k]];
    }

    /// Along the front normal, as long as twice the area; m^2.
    [[nodiscard]] MIR_HD Vec3 area_vector(std::uint32_t t) const {
        return glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
    }

    /// m^2.
    [[nodiscard]] MIR_HD float area(std::uint32_t triangle) const {
        return 0.5f * long_length(area_vector(triangle));
    }

    /// Unit normal of the front of a triangle.
    [[nodiscard]] MIR_HD Vec3 front_normal(std::uint32_t triangle) const {
        const Vec3 n = area_vector(triangle);
        return n / long_length(n);
    }

    /// Point of a triangle at barycentrics of its second and third corner, metres. In double
    /// precision, rounded once: it lies in the triangle's plane to a unit of rounding at the place,
    /// however large the triangle is.
    [[nodiscard]] MIR_HD Vec3 position(std::uint32_t triangle, Vec2 barycentrics) const {
        const TriangleIndices& t = triangles[triangle];
        const Vec3 a = positions[t[0]];
        const Vec3 b = positions[t[1]];
        const Vec3 c = positions[t[2]];
        const double u = static_cast<double>(barycentrics.x);
        const double v = static_cast<double>(barycentrics.y);
        const double w = strict::sub(strict::sub(1.0, u), v);
        const auto mean = [=](float x, float y, float z) {
            const double first = strict::mul(w, static_cast<double>(x));
            const double second = strict::mul(u, static_cast<double>(y));
            const double third = strict::mul(v, static_cast<double>(z));
            return static_cast<float>(strict::add(strict::add(first, second), third));
        };
        return {mean(a.x, b.x, c.x), mean(a.y, b.y, c.y), mean(a.z, b.z, c.z)};
    }

    /// Distance by which segments that leave `position`, metres, are lifted off its surface,
    /// metres. At least least_offset(). Beyond that `ray_offset`, which lets shafts see that a
    /// surface does not hide its own points, while it is less than 2^-13 of `seen_from`: of the
    /// distance from which the point is seen, or of the size of what it lies on.
    [[nodiscard]] MIR_HD float offset_at(Vec3 position, float seen_from = INFINITY) const {
        return larger(least_offset(position), smaller(ray_offset, 0x1p-13f * seen_from));
    }

    /// Place on a triangle where segments may leave. It is position(), moved in the triangle's
    /// plane so that it keeps off the edges by four times `offset`, metres, and by what
    /// barycentrics round. A point by an edge would, once lifted, lie in the neighbour's plane or
    /// behind it. Triangles that are too narrow keep a quarter of each height.
    [[nodiscard]] MIR_HD Vec3 place(std::uint32_t triangle, Vec2 barycentrics, float offset) const {
        return position(triangle, barycentrics) + shift_off_edges(triangle, barycentrics, offset);
    }

    /// At barycentrics of the second and third corner.
    [[nodiscard]] MIR_HD VertexAttributes attributes(std::uint32_t triangle,
                                                     Vec2 barycentrics) const;

    /// Point of a triangle at barycentrics of its second and third corner. A ray that travels
    /// along `direction` sees it, from so far that only the scene's size decides how much it is
    /// lifted.
    [[nodiscard]] MIR_HD SurfacePoint surface_point(std::uint32_t triangle, Vec2 barycentrics,
                                                    Vec3 direction) const {
        return surface_point(triangle, barycentrics, direction, INFINITY);
    }
    /// The same, seen by a ray from its origin.
    [[nodiscard]] MIR_HD SurfacePoint surface_point(std::uint32_t triangle, Vec2 barycentrics,
                                                    const Ray& ray) const {
        return surface_point(triangle, barycentrics, ray.direction,
                             max_abs(position(triangle, barycentrics) - ray.origin));
    }

 private:
    /// Euclidean; of vectors whose square is no float, too.
    [[nodiscard]] MIR_HD static float long_length(Vec3 v) {
        const float largest = max_abs(v);
        return largest > 0.0f ? largest * glm::length(v / largest) : 0.0f;
    }
    [[nodiscard]] MIR_HD SurfacePoint surface_point(std::uint32_t triangle, Vec2 barycentrics,
                                                    Vec3 direction, float distance) const;
    [[nodiscard]] MIR_HD Vec3 shift_off_edges(std::uint32_t triangle, Vec2 barycentrics,
                                              float margin) const;
    MIR_HD void set_texture_frame(SurfacePoint& p) const;
};

template <Space S>
MIR_HD VertexAttributes GeometryView<S>::attributes(std::uint32_t triangle,
                                                    Vec2 barycentrics) const {
    const TriangleIndices& t = triangles[triangle];
    const float u = barycentrics.x;
    const float v = barycentrics.y;
    const float w = 1.0f - u - v;
    VertexAttributes a;
    if (texture_coordinates != nullptr)
        a.texture_coordinates = w * texture_coordinates[t[0]] + u * texture_coordinates[t[1]] +
                                v * texture_coordinates[t[2]];
    if (colors != nullptr) a.color = w * colors[t[0]] + u * colors[t[1]] + v * colors[t[2]];
    return a;
}

template <Space S>
MIR_HD void GeometryView<S>::set_texture_frame(SurfacePoint& p) const {
    const TriangleIndices& t = triangles[p.triangle];
    const Vec3 first = positions[t[1]] - positions[t[0]];
    const Vec3 second = positions[t[2]] - positions[t[0]];
    const Vec2 a = texture_coordinates[t[1]] - texture_coordinates[t[0]];
    const Vec2 b = texture_coordinates[t[2]] - texture_coordinates[t[0]];
    // Images count v downwards: a map that is not mirrored turns the other way than the triangle.
    const float turn = a.x * b.y - a.y * b.x;
    p.mirrored_texture = turn > 0.0f;
    p.tangent = (turn > 0.0f ? 1.0f : -1.0f) * (b.y * first - a.y * second);
}

template <Space S>
MIR_HD Vec3 GeometryView<S>::shift_off_edges(std::uint32_t triangle, Vec2 barycentrics,
                                             float margin) const {
    const TriangleIndices& t = triangles[triangle];
    const Vec3 normal = front_normal(triangle);
    const float twice_area = long_length(area_vector(triangle));
    const float weights[3] = {1.0f - barycentrics.x - barycentrics.y, barycentrics.x,
                              barycentrics.y};
    const float size = larger(max_abs(positions[t[1]] - positions[t[0]]),
                              max_abs(positions[t[2]] - positions[t[0]]));
    const float wanted = 4.0f * margin + 0x1p-22f * size;
    Vec3 shift(0.0f);
    for (int k = 0; k < 3; ++k) {
        const Vec3 edge = positions[t[(k + 2) % 3]] - positions[t[(k + 1) % 3]];
        const float length = long_length(edge);
        const float height = twice_area / length;
        const float missing = smaller(wanted, 0.25f * height) - weights[k] * height;
        if (missing > 0.0f) shift += missing * glm::cross(normal, edge / length);
    }
    return shift;
}

template <Space S>
MIR_HD SurfacePoint GeometryView<S>::surface_point(std::uint32_t triangle, Vec2 barycentrics,
                                                   Vec3 direction, float distance) const {
    const TriangleIndices& t = triangles[triangle];
    const float u = barycentrics.x;
    const float v = barycentrics.y;
    const float w = 1.0f - u - v;
    SurfacePoint p;
    p.position = position(triangle, barycentrics);
    p.offset = offset_at(p.position, distance);
    p.position += shift_off_edges(triangle, barycentrics, p.offset);
    p.barycentrics = barycentrics;
    p.triangle = triangle;
    p.material = materials[triangle];
    const Vec3 normal = front_normal(triangle);
    p.front = glm::dot(direction, normal) <= 0.0f;
    p.geometric_normal = p.front ? normal : -normal;
    const Vec3 smooth = w * normals[t[0]] + u * normals[t[1]] + v * normals[t[2]];
    const float length = glm::length(smooth);
    p.shading_normal = length > 0.0f ? smooth / length : p.geometric_normal;
    if (glm::dot(p.shading_normal, p.geometric_normal) < 0.0f) p.shading_normal = -p.shading_normal;
    const VertexAttributes own = attributes(triangle, barycentrics);
    p.texture_coordinates = own.texture_coordinates;
    p.color = own.color;
    if (texture_coordinates != nullptr) set_texture_frame(p);
    return p;
}

}  // namespace mir
