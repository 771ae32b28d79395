// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/core/frame.hpp"
#include "mir/core/random.hpp"
#include "mir/core/warp.hpp"
#include "mir/micro/gather_options.hpp"
#include "mir/micro/surfel_radiance.hpp"
#include "mir/micro/surfel_traverse.hpp"

namespace mir {

namespace detail {

/// Points of a Kronecker sequence in the unit square, shifted at random. Each is uniform, together
/// they are spread evenly. In fixed point, so that none is worse than the first. Source: Roberts,
/// "The unreasonable effectiveness of quasirandom sequences", 2018.
class ShiftedPoints {
 public:
    MIR_HD explicit ShiftedPoints(Random random) {
        const Vec2 shift = random.next_2d() * 0x1p24f;
        x_ = static_cast<std::uint32_t>(shift.x) << 8;
        y_ = static_cast<std::uint32_t>(shift.y) << 8;
    }
    [[nodiscard]] MIR_HD Vec2 operator[](std::uint32_t k) const {
        return {to_unit_float(x_ + k * 0xC13FA9A9u), to_unit_float(y_ + k * 0x91E10DA6u)};
    }

 private:
    std::uint32_t x_;
    std::uint32_t y_;
};

/// A direction above a surface in its frame, and its density per steradian.
struct LocalDirection {
    Vec3 w{0};
    float pdf = 0.0f;
};

MIR_HD inline LocalDirection gather_direction(GatherDirections kind, Vec2 u) {
    if (kind == GatherDirections::uniform) return {square_to_cone(u, 0.0f), cone_pdf(0.0f)};
    const Vec3 w = square_to_cosine_hemisphere(u);
    return {w, cosine_hemisphere_pdf(w.z)};
}

/// The rays of one gather and what they meet: `rays(SurfelRay)` is a SurfelHit.
template <class Rays>
struct GatherRays {
    Rays rays;
    GatherOptions options;

    /// What a ray from `from` meets. The point `u` of the unit square picks its direction above the
    /// plane.
    [[nodiscard]] SurfelHit along(const Hit& from, Vec2 u) const {
        const LocalDirection d = gather_direction(options.directions, u);
        return along(from, Frame::around(from.normal).to_world(d.w), d);
    }

    /// Calls found(wi, d, hit) for each ray above the horizon that meets something. Its direction
    /// in the world and in the frame of `normal`, and what it meets.
    template <class Found>
    MIR_HD void each(const Hit& from, Vec3 normal, Random random, const Found& found) const {
        const Frame frame = Frame::around(normal);
        const ShiftedPoints points(random);
        for (std::uint32_t k = 0; k < options.rays; ++k) {
            const LocalDirection d = gather_direction(options.directions, points[k]);
            const Vec3 wi = frame.to_world(d.w);
            const SurfelHit hit = along(from, wi, d);
            if (hit.node != SurfelHit::none) found(wi, d, hit);
        }
    }

    /// Radiance towards the viewer of the light that nodes send out, W m^-2 sr^-1.
    template <Bsdf B>
    [[nodiscard]] MIR_HD Rgb light(const SurfelRadiance* radiance, const Hit& hit,
                                   const Surface<typename B::Params>& s, Random random) const {
        Rgb sum;
        if (is_empty(hit) || B::is_black(s.bsdf)) return sum;
        const auto add = [&](Vec3 wi, const LocalDirection& d, const SurfelHit& met) {
            sum += B::eval(s.bsdf, s.normal, wi, s.wo) * radiance[met.node].of(met.front) *
                   (d.w.z / d.pdf);
        };
        each(hit, s.normal, random, add);
        return sum * (1.0f / static_cast<float>(options.rays));
    }

 private:
    [[nodiscard]] MIR_HD SurfelHit along(const Hit& from, Vec3 wi, const LocalDirection& d) const {
        if (!(d.pdf > 0.0f) || !(d.w.z > 0.0f) || !(glm::dot(wi, from.normal) > 0.0f)) return {};
        const float share = options.threshold / (static_cast<float>(options.rays) * d.pdf);
        return rays(SurfelRay{from.position, wi, from.normal, share});
    }
};

}  // namespace detail

/// Light that reaches a luxel from discs, by rays. The mean of f L cos / p over directions with
/// density p, where L is what closest_surfel() meets. The solid angle of a ray is 1 / (n p): small
/// where directions lie dense. Allocates nothing; a kernel body for host and device.
template <Space S, Bsdf B>
struct RayGather {
    static constexpr Space space = S;  ///< memory that the tree lies in

    SurfelTreeView<S> tree;                    ///< what is seen
    const SurfelRadiance* radiance = nullptr;  ///< of nodes
    GatherOptions options;                     ///< must have passed check()

    /// Radiance towards the viewer, W m^-2 sr^-1. The shift of all directions is drawn from
    /// `random`.
    [[nodiscard]] MIR_HD Rgb operator()(const Hit& hit, const Surface<typename B::Params>& s,
                                        Random random) const {
        const detail::GatherRays<TreeRays<S>> rays{{tree, options.shape}, options};
        return rays.template light<B>(radiance, hit, s, random);
    }
};

}  // namespace mir
