// SPDX-License-Identifier: MIT
#pragma once

#include "mir/paths/light_end.hpp"
#include "mir/paths/wide_rgb.hpp"

namespace mir {

/// What a path carries and how likely each of its vertices is from either side. Visibility is not
/// part of it. Film and lens are measured by their unit squares, x2 by its area in m^2 and
/// x3 .. x_k by theirs in PathWorld::area_unit (a light end without extent by counting, an
/// environment by solid angle), so the camera's own terms are 1. Weights, F over a density, do not
/// depend on the unit.
struct PathMeasure {
    WideRgb contribution;  ///< F: image mean of the radiance that such paths bring, W m^-2 sr^-1
    WideRgb leaving;       ///< R: radiance that leaves x2 towards x1, W m^-2 sr^-1
    WideRgb response;      ///< F / R: what the image receives of R, a factor of x0, x1 and x2 alone
    double area_unit = 1.0;  ///< PathWorld::area_unit, m^2
    // Plain arrays, because device code cannot index std::array.
    double from_eye[max_path_edges + 1] = {};    ///< density of x_i, drawn from x_(i-1)
    double from_light[max_path_edges + 1] = {};  ///< density of x_i, drawn from x_(i+1)
    double next_event = 0.0;                     ///< density of x_k as a light sample for x_(k-1)
    double emission = 0.0;                       ///< density of x_k as the start of a light path
};

namespace detail {

/// Edge from x_i to x_(i+1), i >= 0.
struct PathEdge {
    Vec3 w{0};        ///< unit, away from the camera
    float d2 = 1.0f;  ///< m^2; 1 towards light from outside
};

MIR_HD inline PathEdge edge_between(Vec3 from, Vec3 to) {
    const Vec3 d = to - from;
    const float d2 = length_squared(d);
    return {d * (1.0f / sqrtf(d2)), d2};
}

/// Evaluates one path. Indices are those of the path: x1 is the first hit.
template <class World>
class PathMeasurer {
 public:
    using B = typename World::Bsdf;

    MIR_HD PathMeasurer(const World& world, const Path& path)
        : world_(world), path_(path), k_(path.edges()) {
        for (std::uint32_t i = 2; i < k_; ++i) edges_[i] = edge(i);
        if (path.light.origin == LightOrigin::outside) edges_[k_ - 1] = {-end().normal, 1.0f};
    }

    /// x2 .. x_k alone. False when no light can leave x2, whatever is visible; `m` is unfinished
    /// then.
    MIR_HD bool run_suffix(PathMeasure& m) const {
        m.area_unit = world_.area_unit;
        m.next_event = path_.light.pdf_next_event * unit_of(k_);
        m.emission = path_.light.pdf_emission * unit_of(k_);
        if (!is_representable() || !suffix_sides_agree()) return false;
        m.leaving = leaving_second();
        if (is_black(m.leaving)) return false;
        for (std::uint32_t i = 3; i <= k_; ++i) m.from_eye[i] = density_from_eye(i);
        for (std::uint32_t i = 2; i < k_; ++i) m.from_light[i] = density_from_light(i);
        return true;
    }

    /// The whole path.
    MIR_HD bool run(PathMeasure& m) {
        if (!run_suffix(m)) return false;
        for (std::uint32_t i = 0; i < 2; ++i) edges_[i] = edge(i);
        if (!camera_sides_agree()) return false;
        m.response = WideRgb(path_.chain * bsdf(1)) *
                     static_cast<double>(smaller(geometry(1), world_.bound));
        m.contribution = m.response * m.leaving;
        m.from_eye[2] = density_from_eye(2);
        return !is_black(m.contribution);
    }

 private:
    [[nodiscard]] MIR_HD const PathVertex& end() const { return path_.x(k_); }
    /// Unit vector from x_i towards the light, and towards the camera.
    [[nodiscard]] MIR_HD Vec3 to_light(std::uint32_t i) const { return edges_[i].w; }
    [[nodiscard]] MIR_HD Vec3 to_eye(std::uint32_t i) const { return -edges_[i - 1].w; }

    /// What a density of x_i per m^2 is multiplied by. 1 where x_i is not measured by its area.
    [[nodiscard]] MIR_HD double unit_of(std::uint32_t i) const {
        const bool by_area = i < k_ || ends_on_surface();
        return i > 2 && by_area ? world_.area_unit : 1.0;
    }

    [[nodiscard]] MIR_HD bool ends_on_surface() const {
        return path_.light.origin == LightOrigin::surface;
    }
    /// Lights that no ray meets are no VPLs: they need a reflecting x2.
    [[nodiscard]] MIR_HD bool is_representable() const {
        return k_ > 2 || (k_ == 2 && ends_on_surface());
    }
    /// Normals of the side where light arrives.
    [[nodiscard]] MIR_HD Vec3 lit_normal(std::uint32_t i) const {
        return path_.is_lit_behind(i) ? -path_.x(i).normal : path_.x(i).normal;
    }
    [[nodiscard]] MIR_HD Vec3 lit_shading_normal(std::uint32_t i) const {
        return path_.is_lit_behind(i) ? -path_.x(i).shading_normal : path_.x(i).shading_normal;
    }
    /// A direction on one side of x_i as the Bsdf of what goes through wants it on the other.
    [[nodiscard]] MIR_HD Vec3 turned(std::uint32_t i, Vec3 w) const {
        return path_.is_lit_behind(i) ? -w : w;
    }
    [[nodiscard]] MIR_HD PathEdge edge(std::uint32_t i) const {
        return edge_between(path_.position(i), path_.position(i + 1));
    }
    [[nodiscard]] MIR_HD bool is_lit(std::uint32_t i) const {
        return glm::dot(to_light(i), lit_normal(i)) > 0.0f &&
               glm::dot(to_light(i), lit_shading_normal(i)) > 0.0f;
    }
    /// Reflecting vertices must see both neighbours on their side, and light above the normal. That
    /// is the shading normal. Whether it reflects below that is the BSDF's matter.
    [[nodiscard]] MIR_HD bool suffix_sides_agree() const {
        for (std::uint32_t i = 2; i < k_; ++i) {
            if (!is_lit(i)) return false;
            if (i > 2 && !(glm::dot(to_eye(i), path_.x(i).normal) > 0.0f)) return false;
        }
        const bool lamp_behind = k_ > 2 && ends_on_surface();
        return !lamp_behind || glm::dot(to_eye(k_), end().normal) > 0.0f;
    }
    [[nodiscard]] MIR_HD bool camera_sides_agree() const {
        const PathVertex& x = path_.x(1);
        return is_lit(1) && glm::dot(to_eye(1), x.normal) > 0.0f &&
               glm::dot(to_eye(1), x.shading_normal) > 0.0f &&
               glm::dot(to_eye(2), path_.x(2).normal) > 0.0f;
    }

    /// cos at x_i, shading normal, times cos at x_(i+1), geometric normal, over d^2.
    [[nodiscard]] MIR_HD float geometry(std::uint32_t i) const {
        const PathEdge& e = edges_[i];
        const float receiver = larger(glm::dot(e.w, lit_shading_normal(i)), 0.0f);
        return receiver * larger(-glm::dot(e.w, path_.x(i + 1).normal), 0.0f) / e.d2;
    }
    /// Irradiance at the last reflecting vertex.
    [[nodiscard]] MIR_HD Rgb light_at(std::uint32_t receiver) const {
        const PathEdge& e = edges_[receiver];
        const float cosine = larger(glm::dot(e.w, lit_shading_normal(receiver)), 0.0f);
        return light_at_receiver(world_, end(), path_.light, -e.w, e.d2) * cosine;
    }
    [[nodiscard]] MIR_HD Rgb bsdf(std::uint32_t i) const {
        const PathVertex& x = path_.x(i);
        return B::eval(world_.params(x), lit_shading_normal(i), to_light(i), turned(i, to_eye(i)));
    }
    /// Irradiance at x2, spread diffusely, or the emission of a lamp there.
    [[nodiscard]] MIR_HD WideRgb leaving_second() const {
        if (k_ == 2) return path_.light.emission;
        WideRgb light = WideRgb(light_at(k_ - 1)) * unit_of(k_);
        for (std::uint32_t i = k_ - 1; i > 2; --i)
            light = light * bsdf(i) * (static_cast<double>(geometry(i - 1)) * unit_of(i)) *
                    static_cast<double>(world_.event_weight(path_.x(i)));
        const PathVertex& x = path_.x(2);
        const BsdfSample sample =
            B::sample(world_.params(x), x.shading_normal, turned(2, to_light(2)),
                      {path_.spread.x, path_.spread.y}, path_.spread.z);
        return light * sample.weight * static_cast<double>(inv_pi * world_.event_weight(x));
    }
    [[nodiscard]] MIR_HD double density_from_eye(std::uint32_t i) const {
        const PathEdge& e = edges_[i - 1];
        const PathVertex& from = path_.x(i - 1);
        if (i == k_ && !ends_on_surface()) return 0.0;
        const Vec3 normal = lit_shading_normal(i - 1);
        const float cosine = larger(-glm::dot(e.w, path_.x(i).normal), 0.0f);
        const float pdf =
            i == 3 ? cosine_hemisphere_pdf(glm::dot(e.w, normal))
                   : B::pdf(world_.params(from), normal, e.w, turned(i - 1, to_eye(i - 1)));
        const double density = per_area(pdf, cosine, e) * unit_of(i);
        // Light samples put an end on a lamp that a ray may pass.
        return i == k_ ? density * static_cast<double>(world_.stop_chance(end(), e.w)) : density;
    }
    [[nodiscard]] MIR_HD double density_from_light(std::uint32_t i) const {
        const PathEdge& e = edges_[i];
        const float cosine = larger(glm::dot(e.w, lit_normal(i)), 0.0f);
        if (i + 1 == k_)
            return light_ray_density(world_, end(), path_.light, -e.w, cosine, e.d2) * unit_of(i);
        const PathVertex& from = path_.x(i + 1);
        const float pdf =
            B::pdf(world_.params(from), from.shading_normal, -e.w, turned(i + 1, to_light(i + 1)));
        return per_area(pdf, cosine, e) * unit_of(i);
    }
    /// Density per m^2 at the end of an edge. It follows from a direction's density and the cosine
    /// there.
    [[nodiscard]] MIR_HD static double per_area(float pdf, float cosine, const PathEdge& e) {
        return static_cast<double>(pdf) * static_cast<double>(cosine) / static_cast<double>(e.d2);
    }

    const World& world_;
    const Path& path_;
    std::uint32_t k_;
    PathEdge edges_[max_path_edges];
};

}  // namespace detail

/// Measures x2 .. x_k alone: `leaving`, `from_light`, `from_eye` from x3 on, and the light's own
/// densities. x0 and x1 are not read. False when no light can leave x2.
template <class World>
MIR_HD_CALL bool measure_suffix(const World& world, const Path& path, PathMeasure& m) {
    return detail::PathMeasurer<World>(world, path).run_suffix(m);
}

/// Measures a path of 2 to max_path_edges edges. False when no light can pass along it.
template <class World>
MIR_HD_CALL bool measure_path(const World& world, const Path& path, PathMeasure& m) {
    return detail::PathMeasurer<World>(world, path).run(m);
}

}  // namespace mir
