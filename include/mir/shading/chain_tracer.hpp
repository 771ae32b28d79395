// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/ray_caster.hpp"
#include "mir/core/decay.hpp"
#include "mir/shading/chain_step.hpp"

namespace mir {

/// Where a ray ends that mirrors, glass and open surfaces send on.
struct ChainEnd {
    Ray ray;                    ///< the last one: that met the point, or that left the scene
    SurfacePoint point;         ///< means nothing where the background is met
    bool is_background = true;  ///< the last ray met no surface
    /// What the chain leaves of emission and background at its end, over its probability.
    Rgb light{1.0f, 1.0f, 1.0f};
    /// The same of what the end's Bsdf reflects. It may be less: a blended surface covers a part.
    Rgb reflection{1.0f, 1.0f, 1.0f};
    float before = 0.0f;       ///< metres travelled before `ray`
    std::uint32_t events = 0;  ///< surfaces that the ray went on from
    bool is_straight = true;   ///< none of them has changed its direction
};

/// Follows rays through specular chains to the first surface that ends them. A value of views;
/// const use from any thread. A chain longer than `longest` events is lost.
template <class R, Space S, Bsdf B>
struct ChainTracer {
    static_assert(CastsRaysFrom<R, S>,
                  "mir: chains in a kernel need a ray caster that reads the "
                  "same memory, such as KdRayCaster<Space::device>");
    static constexpr std::uint32_t longest = 48;  ///< events of a chain

    R caster;                         ///< what rays meet
    SurfaceTableView<S, B> surfaces;  ///< materials and their textures

    /// Goes on from what a ray met. `end` holds it, and where the chain ends afterwards. Numbers as
    /// for chain_step(): none are drawn where nothing is chained.
    template <class Numbers>
    MIR_HD void follow(ChainEnd& end, Transport transport, Numbers& numbers) const {
        if constexpr (ChainBsdf<B>) {
            std::uint32_t inside = nowhere;
            while (!end.is_background && surfaces.is_chained(end.point.material)) {
                if (end.events == longest) return lose(end);
                absorb(end, inside);
                const ChainSurface surface = surface_of(end);
                const ChainStep step = step_of(end, surface, transport, numbers);
                if (step.event == ChainEvent::stop || is_black(step.weight)) return stop(end, step);
                end.light = end.light * step.weight;
                if (step.event == ChainEvent::transmit && surface.bounds_body())
                    inside = surface.front ? end.point.material : nowhere;
                if (!go_on(end, step) || !survives(end, numbers)) return lose(end);
            }
            if (!end.is_background) absorb(end, inside);
            end.reflection = end.light;
        }
    }

 private:
    static constexpr std::uint32_t nowhere = ~0u;

    [[nodiscard]] MIR_HD ChainSurface surface_of(const ChainEnd& end) const {
        const SurfacePoint& p = end.point;
        const VertexAttributes at = attributes_of(p);
        const Vec3 wo = -end.ray.direction;
        return {surfaces.factors(p.material, at),
                surfaces.coverage(p.material, at),
                surfaces.seen_normal(p, wo),
                p.geometric_normal,
                wo,
                p.front};
    }

    template <class Numbers>
    [[nodiscard]] MIR_HD ChainStep step_of(const ChainEnd& end, const ChainSurface& s,
                                           Transport transport, Numbers& numbers) const {
        typename B::Params p = chain_end_params<B>(s.factors);
        if (surfaces.is_inside_body(end.point.material, end.point.front)) p = B::without_lobe(p);
        const bool shines = surfaces.shines(end.point);
        const float albedo = shines ? 1.0f : luminance(B::albedo(p, s.normal, s.wo));
        return chain_step(s, B::is_black(p) && !shines ? 0.0f : larger(albedo, 0.05f), transport,
                          numbers);
    }

    /// What the body takes away that the last edge ran through.
    MIR_HD void absorb(ChainEnd& end, std::uint32_t inside) const {
        const SurfacePoint& p = end.point;
        if (inside == nowhere && !surfaces.is_inside_body(p.material, p.front)) return;
        const Rgb rate = surfaces.absorption(inside == nowhere ? p.material : inside);
        if (is_black(rate)) return;
        const float d = glm::length(p.position - end.ray.origin);
        end.light = end.light * Rgb{decay(rate.r * d), decay(rate.g * d), decay(rate.b * d)};
    }

    MIR_HD static void stop(ChainEnd& end, const ChainStep& step) {
        end.reflection = end.light * step.weight;
        end.light = end.light * (1.0f / step.probability);
        if (is_black(step.weight)) lose(end);
    }
    MIR_HD static void lose(ChainEnd& end) { end.light = end.reflection = {}; }

    /// Traces the next edge. False where the direction runs into its own surface.
    [[nodiscard]] MIR_HD bool go_on(ChainEnd& end, const ChainStep& step) const {
        const SurfacePoint& p = end.point;
        const float side = step.event == ChainEvent::mirror ? 1.0f : -1.0f;
        const Vec3 normal = side * p.geometric_normal;
        if (!(glm::dot(step.direction, normal) > 0.0f)) return false;
        const Vec3 from = lift(p.position, normal, larger(p.offset, least_offset(p.position)));
        end.before += glm::length(p.position - end.ray.origin);
        end.ray = {from, step.direction};
        end.is_straight = end.is_straight && step.event == ChainEvent::pass;
        ++end.events;
        end.is_background = !find_point(caster, end.ray, end.point);
        return true;
    }

    /// Ends long chains that bring little, by chance.
    template <class Numbers>
    [[nodiscard]] MIR_HD static bool survives(ChainEnd& end, Numbers& numbers) {
        constexpr std::uint32_t always = 4;
        const float odds = max_channel(end.light);
        if (end.events < always || odds >= 0.25f) return true;
        const float chance = larger(4.0f * odds, 0.05f);
        if (!(numbers.next() < chance)) return false;
        end.light = end.light * (1.0f / chance);
        return true;
    }
};
template <class R, Space S, class B>
ChainTracer(R, SurfaceTableView<S, B>) -> ChainTracer<R, S, B>;

}  // namespace mir
