// SPDX-License-Identifier: MIT
#pragma once

#include "mir/reference/bound_split.hpp"
#include "mir/reference/path_rules.hpp"
#include "mir/reference/path_tracer_options.hpp"
#include "mir/reference/path_tracer_world.hpp"
#include "mir/reference/rgb_moments.hpp"
#include "mir/shading/environment_light.hpp"
#include "mir/shading/luxel_tracer.hpp"
#include "mir/shading/scene_light.hpp"

#include <algorithm>
#include <optional>
#include <span>

namespace mir {

/// Unidirectional path tracer with next-event estimation, the reference of other estimators.
/// Radiance is split by the number b of scattering events: D_0 emission seen directly, D_1 direct
/// light, D_b what VPLs of bounce b bring. Unbiased, up to `max_bounce` if there is one. Lights
/// that the scene lists are summed at every vertex, since no direction finds them. Rays that leave
/// the scene see its environment.
///
/// Conventions are those of docs/method.md, 4: shading normal at the receiver, geometric normal at
/// the emitter, black where shading and geometric side disagree, points lifted by
/// WorldGeometry::ray_offset(). Sources: Kajiya, "The rendering equation", SIGGRAPH 1986; Veach
/// 1997, chapter 9. A value of views for host and device; what they read must outlive it. Const use
/// from any thread.
template <Bsdf B, class R, Visibility V, PathRules Rules = BalanceRules>
class PathTracer {
 public:
    /// What paths run through.
    using World = PathTracerWorld<B, R, V>;
    static constexpr Space space = World::space;  ///< memory that the views read

    /// A lifted point of a surface, seen from where the path came from.
    struct Vertex {
        Hit hit;                              ///< place, lifted, and geometric normal
        Surface<typename B::Params> surface;  ///< towards where the path came from
    };

    /// @throws Error(invalid_argument) when options are out of range.
    PathTracer(const World& world, PathTracerOptions options);

    /// As they were given.
    [[nodiscard]] const PathTracerOptions& options() const { return options_; }

    /// What a camera ray sees: the luxel that fill_gbuffer() stores, before the environment. Where
    /// is_drawn(), `plan` may ask for another end of its chain.
    [[nodiscard]] Vertex luxel(const Ray& ray, SpecularPlan plan = {}) const {
        const SeenLuxel seen = luxels_(ray, plan);
        return {luxels_.hit(seen), luxels_.surface(seen, environment_)};
    }
    /// Whether a camera ray meets a surface first from which it may go on.
    [[nodiscard]] bool is_drawn(const Ray& ray) const {
        SurfacePoint point;
        return find_point(world_.caster, ray, point) &&
               luxels_.surfaces.is_specular(point.material);
    }

    /// Adds one estimate of the radiance from `first` towards the viewer, W m^-2 sr^-1. D_b is
    /// added to element b of `bounces`, which has two elements or more. The last one takes all
    /// later bounces too. An empty luxel has D_0 alone: its emission.
    void trace(const Vertex& first, Random& random, std::span<RgbSum> bounces) const {
        BounceSums sums{bounces};
        trace_to(sums, first, random);
    }
    /// The same, given to `sums` part by part: sums.add(b, light) for light of bounce b.
    template <class Sums>
    MIR_HD void trace_to(Sums& sums, const Vertex& first, Random& random) const;

 private:
    static constexpr std::uint32_t endless = 0xFFFFFFFFu;  ///< last_bounce_ where there is none

    /// One sum for each bounce. The last one takes all later ones.
    struct BounceSums {
        std::span<RgbSum> bounces;

        void add(std::uint32_t bounce, Rgb light) {
            bounces[std::min<std::size_t>(bounce, bounces.size() - 1)] += light;
        }
    };

    /// A path under way. The light samples of `at`, its vertex number `bounce`, are done.
    struct Walk {
        Vertex at;
        float share = 1.0f;  ///< of the directions of the first vertex
        std::uint32_t bounce = 1;
        Rgb throughput{1.0f, 1.0f, 1.0f};
    };

    [[nodiscard]] MIR_HD bool has_lamps() const { return !world_.lights.lamps.by_power.empty(); }
    [[nodiscard]] MIR_HD std::uint32_t light_samples_at(std::uint32_t bounce) const;
    [[nodiscard]] MIR_HD std::uint32_t directions_at(std::uint32_t bounce) const;
    [[nodiscard]] MIR_HD Rgb sampled_light(const Vertex& at, std::uint32_t bounce,
                                           Random& random) const;
    [[nodiscard]] MIR_HD Rgb light_sample(const Vertex& at, std::uint32_t bounce,
                                          Random& random) const;
    [[nodiscard]] MIR_HD SpecularEnd met_along(const Walk& walk, Vec3 direction,
                                               Random& random) const;
    /// What of the light is wanted that the first vertex gets from another. A VPL there shines to
    /// the side that the path came from, wherever its light arrives.
    [[nodiscard]] MIR_HD float share_of(const Walk& walk, const SpecularEnd& met,
                                        const Hit& next) const {
        if (!met.is_straight) return split_.unbounded();
        const Hit from{next.position, met.is_through ? -next.normal : next.normal};
        return split_.reflected(walk.at.hit, walk.at.surface.normal, from);
    }
    [[nodiscard]] MIR_HD Rgb found_light(const Walk& walk, const BsdfSample& sample,
                                         const SpecularEnd& met, const Vertex& next) const;
    [[nodiscard]] MIR_HD bool find_next_point(const Walk& walk, const Ray& ray,
                                              SurfacePoint& point) const;
    [[nodiscard]] MIR_HD Rgb environment_sample(const Vertex& at, std::uint32_t bounce,
                                                Random& random) const;
    [[nodiscard]] MIR_HD Rgb found_environment(const Walk& walk, const BsdfSample& sample,
                                               const SpecularEnd& met) const;
    [[nodiscard]] MIR_HD bool is_all_wanted(std::uint32_t bounce) const;
    [[nodiscard]] MIR_HD bool is_wanted(const SpecularEnd& met) const {
        return options_.paths == PathPart::all ||
               met.is_straight == (options_.paths == PathPart::gathered);
    }
    template <class Sums>
    MIR_HD bool advance(Walk& walk, Random& random, Sums& sums) const;

    World world_;
    LuxelTracer<R, space, B> luxels_;
    PathTracerOptions options_;
    std::uint32_t last_bounce_;  ///< PathTracerOptions::max_bounce, in a form that kernels read
    BoundSplit split_;
    ListedLight<B, V> listed_;
    EnvironmentView<space> environment_;
    EnvironmentLight<B, V> environment_light_;
};

template <Bsdf B, class R, Visibility V, PathRules Rules>
PathTracer<B, R, V, Rules>::PathTracer(const World& world, PathTracerOptions options)
    : world_(world),
      luxels_{world.caster, world.surfaces},
      options_(options),
      last_bounce_(options.max_bounce ? *options.max_bounce : endless),
      split_{options.bound, options.part, options.bound_lamps},
      listed_(world.lights, world.visibility),
      environment_(world.lights.environment),
      environment_light_(world.lights, world.visibility, 1) {
    expects(options.light_samples >= 1 && options.light_samples <= 65536,
            "light samples at the first vertex must be 1 to 65536; set LightSearch::directions for "
            "none");
    expects(options.directions >= 1 && options.directions <= 65536,
            "directions at the first vertex must be 1 to 65536");
    expects(!options.max_bounce || (*options.max_bounce >= 1 && *options.max_bounce < 255),
            "the largest bounce must be 1 to 254");
    expects(options.max_bounce || options.roulette_from < 255,
            "paths with neither a largest bounce nor roulette never end; give one of them");
    expects(options.roulette_from >= 1,
            "roulette cannot start before the first vertex; use 1 to 254, or 255 for none");
    expects(options.bound > 0.0f,
            "the bound of the geometry term must be positive (per square metre), or all light of "
            "two bounces and more is lost; leave it at its default for none");
}

template <Bsdf B, class R, Visibility V, PathRules Rules>
template <class Sums>
MIR_HD void PathTracer<B, R, V, Rules>::trace_to(Sums& sums, const Vertex& first,
                                                 Random& random) const {
    const bool has_rest = options_.paths != PathPart::residual;
    if (has_rest) sums.add(0, first.surface.emission * split_.unbounded());
    if (is_empty(first.hit) || B::is_black(first.surface.bsdf)) return;
    if (has_rest) sums.add(1, sampled_light(first, 1, random));
    const float share = 1.0f / static_cast<float>(options_.directions);
    for (std::uint32_t i = 0; i < options_.directions; ++i) {
        Walk walk{first, share};
        while (advance(walk, random, sums)) {
        }
    }
}

/// Writes what a path meets next. False where nothing is met that can count.
template <Bsdf B, class R, Visibility V, PathRules Rules>
MIR_HD bool PathTracer<B, R, V, Rules>::find_next_point(const Walk& walk, const Ray& ray,
                                                        SurfacePoint& point) const {
    if (walk.bounce > 1) return find_point(world_.caster, ray, point);
    // A little farther, because points are lifted once they are met.
    const float reach = split_.reach(glm::dot(ray.direction, walk.at.surface.normal));
    const float lifted = world_.geometry.offset_at(ray.origin);
    return find_point_within(world_.caster, ray, 1.001f * reach + 16.0f * lifted, point);
}

/// Where a path goes on to. The end of a specular chain, or the first surface.
template <Bsdf B, class R, Visibility V, PathRules Rules>
MIR_HD SpecularEnd PathTracer<B, R, V, Rules>::met_along(const Walk& walk, Vec3 direction,
                                                         Random& random) const {
    SpecularEnd met;
    met.ray = {walk.at.hit.position, direction};
    met.is_background = !find_next_point(walk, met.ray, met.point);
    if (!met.is_background)
        SpecularTracer{world_.caster, world_.surfaces}.follow(met, Transport::radiance, random);
    return met;
}

/// One edge further: false when the path is over.
template <Bsdf B, class R, Visibility V, PathRules Rules>
template <class Sums>
MIR_HD bool PathTracer<B, R, V, Rules>::advance(Walk& walk, Random& random, Sums& sums) const {
    const bool last = walk.bounce == last_bounce_;
    if (last && directions_at(walk.bounce) == 0) return false;
    const float chance = random.next();
    if (walk.bounce >= options_.roulette_from)
        walk.throughput = Rules::roulette(walk.throughput, chance);
    const auto& [hit, surface] = walk.at;
    const Vec2 uv = random.next_2d();
    const BsdfSample sample =
        B::sample(surface.bsdf, surface.normal, surface.wo, uv, random.next());
    walk.throughput = walk.throughput * sample.weight;
    if (is_black(walk.throughput) || !(glm::dot(sample.wi, hit.normal) > 0.0f)) return false;
    const SpecularEnd met = met_along(walk, sample.wi, random);
    if (walk.bounce == 1 && !is_wanted(met)) return false;
    if (met.is_background) {
        sums.add(walk.bounce, walk.throughput * found_environment(walk, sample, met) * walk.share);
        return false;
    }

    Vertex next{LuxelTracer<R, space, B>::hit(met),
                world_.surfaces.surface(met.point, -met.ray.direction)};
    luxels_.weaken(met, next.surface);
    const Rgb found = found_light(walk, sample, met, next);
    sums.add(walk.bounce, walk.throughput * found * walk.share);
    if (last || B::is_black(next.surface.bsdf)) return false;
    if (walk.bounce == 1) walk.throughput = walk.throughput * share_of(walk, met, next.hit);
    if (is_black(walk.throughput)) return false;
    walk.at = next;
    ++walk.bounce;
    const Rgb light = sampled_light(walk.at, walk.bounce, random);
    sums.add(walk.bounce, walk.throughput * light * walk.share);
    return true;
}

/// Points on emissive triangles that a vertex asks for, and directions towards the environment.
template <Bsdf B, class R, Visibility V, PathRules Rules>
MIR_HD std::uint32_t PathTracer<B, R, V, Rules>::light_samples_at(std::uint32_t bounce) const {
    if (options_.light == LightSearch::directions) return 0;
    return bounce == 1 ? options_.light_samples : 1;
}

/// Scattered directions of a vertex that may find emissive triangles or the environment.
template <Bsdf B, class R, Visibility V, PathRules Rules>
MIR_HD std::uint32_t PathTracer<B, R, V, Rules>::directions_at(std::uint32_t bounce) const {
    const bool any = has_lamps() || !environment_.empty();
    if (options_.light == LightSearch::lamps || !any) return 0;
    return bounce == 1 ? options_.directions : 1;
}

/// Light that the samples of a vertex bring, f cos included, W m^-2 sr^-1.
template <Bsdf B, class R, Visibility V, PathRules Rules>
MIR_HD Rgb PathTracer<B, R, V, Rules>::sampled_light(const Vertex& at, std::uint32_t bounce,
                                                     Random& random) const {
    const std::uint32_t samples = light_samples_at(bounce);
    Rgb sum;
    if (has_lamps())
        for (std::uint32_t i = 0; i < samples; ++i) sum += light_sample(at, bounce, random);
    if (!environment_.empty() && is_all_wanted(bounce))
        for (std::uint32_t i = 0; i < samples; ++i) sum += environment_sample(at, bounce, random);
    if (samples > 1) sum = sum * (1.0f / static_cast<float>(samples));
    if (!is_all_wanted(bounce)) return sum;
    return sum + listed_(at.hit, at.surface, [&](std::uint32_t) { return random.next_2d(); });
}

/// Whether a vertex counts light without a bound: lights without extent, the
/// environment.
template <Bsdf B, class R, Visibility V, PathRules Rules>
MIR_HD bool PathTracer<B, R, V, Rules>::is_all_wanted(std::uint32_t bounce) const {
    return bounce > 1 || split_.unbounded() > 0.0f;
}

template <Bsdf B, class R, Visibility V, PathRules Rules>
MIR_HD Rgb PathTracer<B, R, V, Rules>::light_sample(const Vertex& at, std::uint32_t bounce,
                                                    Random& random) const {
    const float pick = random.next();
    const EmitterSample lamp = world_.lights.lamps.sample(world_.geometry, pick, random.next_2d());
    const Vec3 eye = at.hit.position;
    const LightPoint e = lamp.on_side(lamp.shows_back(eye));
    const Vec3 d = e.position - eye;
    const float d2 = length_squared(d);
    const Vec3 wi = d * (1.0f / std::sqrt(d2));
    const float cosine = -glm::dot(wi, e.normal);
    if (!(cosine > 0.0f)) return {};
    const float share =
        bounce == 1 ? split_.emitted(at.hit, at.surface.normal, {e.position, e.normal}) : 1.0f;
    const Rgb light = reflected<B>(at.hit, at.surface, wi) * e.emission * share;
    if (is_black(light) || !world_.visibility.visible(eye, e.position)) return {};

    const float density = Rules::per_steradian(e.pdf, d2, cosine);
    const float sampled = static_cast<float>(light_samples_at(bounce)) * density;
    const float found = static_cast<float>(directions_at(bounce)) *
                        B::pdf(at.surface.bsdf, at.surface.normal, wi, at.surface.wo);
    return light * (Rules::mis(sampled, found) / density);
}

template <Bsdf B, class R, Visibility V, PathRules Rules>
MIR_HD Rgb PathTracer<B, R, V, Rules>::environment_sample(const Vertex& at, std::uint32_t bounce,
                                                          Random& random) const {
    const EnvironmentSample from = environment_.sample(random.next_2d());
    const Rgb light = environment_light_.unshadowed(at.hit, at.surface, from);
    const Vec3 target = environment_light_.outside(at.hit.position, from.direction);
    if (is_black(light) || !world_.visibility.visible(at.hit.position, target)) return {};
    const float sampled = static_cast<float>(light_samples_at(bounce)) * from.pdf;
    const float found = static_cast<float>(directions_at(bounce)) *
                        B::pdf(at.surface.bsdf, at.surface.normal, from.direction, at.surface.wo);
    return light * Rules::mis(sampled, found);
}

/// Weighted radiance of the environment that a direction escaped to, W m^-2 sr^-1.
template <Bsdf B, class R, Visibility V, PathRules Rules>
MIR_HD Rgb PathTracer<B, R, V, Rules>::found_environment(const Walk& walk, const BsdfSample& sample,
                                                         const SpecularEnd& met) const {
    if (environment_.empty() || !is_all_wanted(walk.bounce)) return {};
    const Rgb radiance = environment_.radiance(met.ray.direction) * met.light;
    if (!met.is_straight) return radiance;
    const std::uint32_t directions = directions_at(walk.bounce);
    if (directions == 0) return {};
    const float sampled = static_cast<float>(light_samples_at(walk.bounce)) *
                          environment_.density(environment_.radiance(sample.wi));
    return radiance * Rules::mis(static_cast<float>(directions) * sample.pdf, sampled);
}

/// Weighted emission of what a direction met, W m^-2 sr^-1.
template <Bsdf B, class R, Visibility V, PathRules Rules>
MIR_HD Rgb PathTracer<B, R, V, Rules>::found_light(const Walk& walk, const BsdfSample& sample,
                                                   const SpecularEnd& met,
                                                   const Vertex& next) const {
    const auto& [hit, surface] = walk.at;
    if (!met.is_straight) return next.surface.emission * split_.unbounded();
    const SurfacePoint& point = met.point;
    const std::uint32_t directions = directions_at(walk.bounce);
    const float share = walk.bounce == 1 ? split_.emitted(hit, surface.normal, next.hit) : 1.0f;
    const Rgb emission = next.surface.emission * share;
    if (is_black(emission) || directions == 0) return {};
    const std::uint32_t samples = light_samples_at(walk.bounce);
    if (samples == 0) return emission;
    const float d2 = length_squared(point.position - hit.position);
    const float cosine = -glm::dot(sample.wi, point.geometric_normal);
    const float sampled =
        static_cast<float>(samples) *
        Rules::per_steradian(world_.lights.lamps.pdf(world_.geometry, point.triangle), d2, cosine);
    return emission * Rules::mis(static_cast<float>(directions) * sample.pdf, sampled);
}

}  // namespace mir
