// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/ray_caster.hpp"
#include "mir/core/decay.hpp"
#include "mir/shading/next_surface.hpp"
#include "mir/shading/specular_step.hpp"

namespace mir {

/// Where a ray ends that mirrors, glass and open surfaces send on.
struct SpecularEnd {
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
    bool on_coat = false;  ///< the end is the rough coat of the surface, and not what lies below
    /// Light goes through the surface diffusely: `point` is turned over, and `ray` comes from
    /// opposite.
    bool is_through = false;
};

/// Follows rays through specular chains to the first surface that ends them. A value of views;
/// const use from any thread. A chain longer than `longest` events is lost.
template <class R, Space S, Bsdf B>
struct SpecularTracer {
    static_assert(CastsRaysFrom<R, S>,
                  "mir: chains in a kernel need a ray caster that reads the "
                  "same memory, such as KdRayCaster<Space::device>");
    static constexpr std::uint32_t longest = 48;  ///< events of a chain

    R caster;                         ///< what rays meet
    SurfaceTableView<S, B> surfaces;  ///< materials and their textures

    /// Goes on from what a ray met. `end` holds it, and where the chain ends afterwards. Numbers as
    /// for specular_step(): none are drawn where nothing is chained. `least` is the smallest
    /// probability of what the first event may be.
    template <class Numbers>
    MIR_HD void follow(SpecularEnd& end, Transport transport, Numbers& numbers,
                       float least = 0.0f) const {
        if constexpr (SpecularBsdf<B>) {
            std::uint32_t inside = nowhere;
            while (!end.is_background && surfaces.is_specular(end.point.material))
                if (!advance(end, inside, {transport, end.events == 0 ? least : 0.0f}, numbers))
                    return;
            if (!end.is_background) absorb(end, inside);
            end.reflection = end.light;
        }
    }

 private:
    static constexpr std::uint32_t nowhere = ~0u;

    /// One event. False when the chain is at its end.
    template <class Numbers>
    [[nodiscard]] MIR_HD bool advance(SpecularEnd& end, std::uint32_t& inside, SpecularRules rules,
                                      Numbers& numbers) const {
        if (end.events == longest) {
            lose(end);
            return false;
        }
        absorb(end, inside);
        const SpecularSurface surface = surface_of(end);
        const SpecularStep step = step_of(end, surface, rules, numbers);
        const bool ends = step.event == SpecularEvent::stop || step.event == SpecularEvent::coat ||
                          step.event == SpecularEvent::through;
        if (ends || is_black(step.weight)) {
            stop(end, step);
            return false;
        }
        end.light = end.light * step.weight;
        if (step.event == SpecularEvent::transmit && surface.bounds_body())
            inside = surface.front ? end.point.material : nowhere;
        if (go_on(end, step) && survives(end, numbers)) return true;
        lose(end);
        return false;
    }

    [[nodiscard]] MIR_HD SpecularSurface surface_of(const SpecularEnd& end) const {
        const SurfacePoint& p = end.point;
        const VertexAttributes at = attributes_of(p);
        const Vec3 wo = -end.ray.direction;
        SpecularSurface s{surfaces.factors(p.material, at),
                          surfaces.coverage(p.material, at),
                          surfaces.seen_normal(p, wo),
                          p.geometric_normal,
                          wo,
                          p.front,
                          B::has_interface,
                          surfaces.coat_normal(p, wo)};
        if (s.factors.diffuse_transmission > 0.0f)
            s.through = luminance(B::albedo(surfaces.through(s.factors), s.normal, wo));
        return s;
    }

    template <class Numbers>
    [[nodiscard]] MIR_HD SpecularStep step_of(const SpecularEnd& end, const SpecularSurface& s,
                                              SpecularRules rules, Numbers& numbers) const {
        const typename B::Params p = surfaces.params_of_side(surfaces.textured_params(s.factors),
                                                             end.point.material, end.point.front);
        const bool shines = surfaces.shines(end.point);
        const float albedo = shines ? 1.0f : luminance(B::albedo(p, s.normal, s.wo));
        return specular_step(s, B::is_black(p) && !shines ? 0.0f : larger(albedo, 0.05f), rules,
                             numbers);
    }

    /// What the body takes away that the last edge ran through.
    MIR_HD void absorb(SpecularEnd& end, std::uint32_t inside) const {
        const SurfacePoint& p = end.point;
        if (inside == nowhere && !surfaces.is_inside_body(p.material, p.front)) return;
        const Rgb rate = surfaces.absorption(inside == nowhere ? p.material : inside);
        if (is_black(rate)) return;
        const float d = glm::length(p.position - end.ray.origin);
        end.light = end.light * Rgb{decay(rate.r * d), decay(rate.g * d), decay(rate.b * d)};
    }

    MIR_HD static void stop(SpecularEnd& end, const SpecularStep& step) {
        end.reflection = end.light * step.weight;
        end.light = end.light * (1.0f / step.probability);
        end.on_coat = step.event == SpecularEvent::coat;
        // What shines is the surface below.
        if (end.on_coat) end.light = {};
        if (step.event == SpecularEvent::through) go_through(end);
        if (is_black(step.weight)) lose(end);
    }
    /// Ends on the other side, as if the ray had met it from opposite. The stop counts the
    /// emission.
    MIR_HD static void go_through(SpecularEnd& end) {
        end.is_through = true;
        end.light = {};
        turn_over(end.point);
        end.ray = {2.0f * end.point.position - end.ray.origin, -end.ray.direction};
    }
    MIR_HD static void lose(SpecularEnd& end) { end.light = end.reflection = {}; }

    /// Traces the next edge. False where the direction runs into its own surface.
    [[nodiscard]] MIR_HD bool go_on(SpecularEnd& end, const SpecularStep& step) const {
        const SurfacePoint& p = end.point;
        const float side = step.event == SpecularEvent::mirror ? 1.0f : -1.0f;
        const Vec3 normal = side * p.geometric_normal;
        if (!(glm::dot(step.direction, normal) > 0.0f)) return false;
        end.before += glm::length(p.position - end.ray.origin);
        end.ray.direction = step.direction;
        end.is_straight = end.is_straight && step.event == SpecularEvent::pass;
        ++end.events;
        end.is_background = !find_next(caster, normal, end.ray, end.point);
        return true;
    }

    /// Ends long chains that bring little, by chance.
    template <class Numbers>
    [[nodiscard]] MIR_HD static bool survives(SpecularEnd& end, Numbers& numbers) {
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
SpecularTracer(R, SurfaceTableView<S, B>) -> SpecularTracer<R, S, B>;

}  // namespace mir
