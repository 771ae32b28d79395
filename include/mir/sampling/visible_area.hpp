// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/camera.hpp"
#include "mir/shading/luxel_tracer.hpp"

#include <cmath>
#include <limits>

namespace mir {

/// The fixed grid of 64 x 64 rays of visible_area(). For host and device.
struct AreaRays {
    static constexpr std::uint32_t side = 64;            ///< rays along each side of the grid
    static constexpr std::uint32_t count = side * side;  ///< rays in all

    CameraOptics optics;  ///< of the camera
    Vec3 back{0, 0, 1};   ///< unit, against the viewing direction
    float aspect = 1.0f;  ///< width / height of the film
    double cell = 0.0;    ///< solid angle of a ray along the axis, sr

    /// `film_aspect` is width / height.
    AreaRays(const Camera& camera, float film_aspect)
        : optics(camera.optics()), back(camera.back), aspect(film_aspect) {
        const double half = std::tan(0.5 * static_cast<double>(camera.vertical_fov));
        cell = 4.0 * half * half * static_cast<double>(aspect) / (side * side);
    }

    /// Ray i < count, row by row from the top left. Through the middle of its cell and of the lens.
    [[nodiscard]] MIR_HD Ray operator()(std::uint32_t i) const {
        const std::uint32_t x = i % side;
        const std::uint32_t y = i / side;
        const Vec2 film((static_cast<float>(x) + 0.5f) / side,
                        (static_cast<float>(y) + 0.5f) / side);
        return optics.ray(film, aspect, {0.5f, 0.5f});
    }

    /// Footprint of a camera ray on the point that it sees, m^2. 0 where it leaves the scene. It is
    /// the solid angle times d^2 / cos, the cosine kept above 0.1 so that a few grazing rays do not
    /// decide.
    [[nodiscard]] MIR_HD double area(const Ray& camera, const SeenLuxel& seen) const {
        if (seen.is_background) return 0.0;
        const Ray& ray = seen.ray;
        const SurfacePoint& point = seen.point;
        const double axis = -static_cast<double>(glm::dot(camera.direction, back));
        const Vec3 edge = point.position - ray.origin;
        const float length = glm::length(edge) + seen.before;
        const float squared = seen.events == 0 ? length_squared(edge) : length * length;
        const auto d2 = static_cast<double>(squared);
        const double cosine = -static_cast<double>(glm::dot(ray.direction, point.geometric_normal));
        return cell * axis * axis * axis * d2 / (cosine < 0.1 ? 0.1 : cosine);
    }
};

/// Kernel over AreaRays: what each covers, m^2; 0 where it leaves the scene.
template <class Tracer>
struct AreaPass {
    AreaRays rays;          ///< what it looks along
    Tracer tracer;          ///< a LuxelTracer: says what they see
    double* out = nullptr;  ///< AreaRays::count areas, m^2

    /// Ray i.
    MIR_HD void operator()(std::uint32_t i) const {
        const Ray ray = rays(i);
        out[i] = rays.area(ray, tracer(ray));
    }
};

template <class Tracer>
AreaPass(AreaRays, Tracer, double*) -> AreaPass<Tracer>;

/// Area of the surfaces that a camera sees, m^2. From a fixed grid of rays (AreaRays). 0 when
/// nothing is seen. Deterministic.
template <class R, Bsdf B>
double visible_area(const Camera& camera, float aspect,
                    const LuxelTracer<R, Space::host, B>& tracer) {
    const AreaRays rays(camera, aspect);
    double area = 0.0;
    for (std::uint32_t i = 0; i < AreaRays::count; ++i) area += rays.area(rays(i), tracer(rays(i)));
    return area;
}

/// The scale-free default bound of the geometry term, m^-2. That of a VPL at the radius r0 at which
/// `vpls` discs cover the visible area, 1 / (pi r0^2) = vpls / area (docs/method.md, 4.3).
inline float default_bound(double visible_area, std::uint32_t vpls) {
    if (!(visible_area > 0.0)) return std::numeric_limits<float>::max();
    return static_cast<float>(static_cast<double>(vpls) / visible_area);
}

}  // namespace mir
