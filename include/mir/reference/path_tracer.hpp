// SPDX-License-Identifier: MIT
#pragma once

#include "mir/reference/bound_split.hpp"
#include "mir/reference/path_rules.hpp"
#include "mir/reference/path_tracer_options.hpp"
#include "mir/reference/rgb_moments.hpp"
#include "mir/shading/environment_light.hpp"
#include "mir/shading/luxel_tracer.hpp"
#include "mir/shading/scene_light.hpp"
#include "mir/shading/surface_table.hpp"

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
/// 1997, chapter 9. The referenced scene data must outlive it; const use from any thread.
template <Bsdf B, RayCaster R, Visibility V, PathRules Rules = BalanceRules>
class PathTracer {
 public:
    /// What paths run through.
    struct World {
        const WorldGeometry& geometry;    ///< outlives the tracer
        const LightTable& lights;         ///< outlives the tracer
        const SurfaceTable<B>& surfaces;  ///< outlives the tracer
        R caster;                         ///< finds what paths meet, from many threads at once
        V visibility;                     ///< asked about lights, from many threads at once
    };

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
        const auto point = world_.caster.closest_hit(ray);
        return point && luxels_.surfaces.is_specular(point->material);
    }

    /// Adds one estimate of the radiance from `first` towards the viewer, W m^-2 sr^-1. D_b is
    /// added to element b of `bounces`, which has two elements or more. The last one takes all
    /// later bounces too. An empty luxel has D_0 alone: its emission.
    void trace(const Vertex& first, Random& random, std::span<RgbSum> bounces) const;

 private:
    /// A path under way. The light samples of `at`, its vertex number `bounce`, are done.
    struct Walk {
        Vertex at;
        float share = 1.0f;  ///< of the directions of the first vertex
        std::uint32_t bounce = 1;
        Rgb throughput{1.0f, 1.0f, 1.0f};
    };

    [[nodiscard]] std::uint32_t light_samples_at(std::uint32_t bounce) const;
    [[nodiscard]] std::uint32_t directions_at(std::uint32_t bounce) const;
    [[nodiscard]] Rgb sampled_light(const Vertex& at, std::uint32_t bounce, Random& random) const;
    [[nodiscard]] Rgb light_sample(const Vertex& at, std::uint32_t bounce, Random& random) const;
    [[nodiscard]] SpecularEnd met_along(const Walk& walk, Vec3 direction, Random& random) const;
    [[nodiscard]] Rgb found_light(const Walk& walk, const BsdfSample& sample,
                                  const SpecularEnd& met, const Vertex& next) const;
    [[nodiscard]] std::optional<SurfacePoint> next_point(const Walk& walk, Vec3 direction) const;
    [[nodiscard]] Rgb environment_sample(const Vertex& at, std::uint32_t bounce,
                                         Random& random) const;
    [[nodiscard]] Rgb found_environment(const Walk& walk, const BsdfSample& sample,
                                        const SpecularEnd& met) const;
    [[nodiscard]] bool is_all_wanted(std::uint32_t bounce) const;
    [[nodiscard]] bool is_wanted(const SpecularEnd& met) const {
        return options_.paths == PathPart::all ||
               met.is_straight == (options_.paths == PathPart::gathered);
    }
    bool advance(Walk& walk, Random& random, std::span<RgbSum> bounces) const;
    static RgbSum& sum_of(std::span<RgbSum> bounces, std::uint32_t bounce) {
        return bounces[std::min<std::size_t>(bounce, bounces.size() - 1)];
    }

    World world_;
    LuxelTracer<R, Space::host, B> luxels_;
    PathTracerOptions options_;
    BoundSplit split_;
    ListedLight<B, V> listed_;
    EnvironmentView<Space::host> environment_;
    EnvironmentLight<B, V> environment_light_;
};

template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
PathTracer<B, R, V, Rules>::PathTracer(const World& world, PathTracerOptions options)
    : world_(world),
      luxels_{world.caster, world.surfaces.view()},
      options_(options),
      split_{options.bound, options.part, options.bound_lamps},
      listed_(world.lights, world.visibility),
      environment_(world.lights.view().environment),
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

template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
void PathTracer<B, R, V, Rules>::trace(const Vertex& first, Random& random,
                                       std::span<RgbSum> bounces) const {
    const bool has_rest = options_.paths != PathPart::residual;
    if (has_rest) bounces[0] += first.surface.emission * split_.unbounded();
    if (is_empty(first.hit) || B::is_black(first.surface.bsdf)) return;
    if (has_rest) bounces[1] += sampled_light(first, 1, random);
    const float share = 1.0f / static_cast<float>(options_.directions);
    for (std::uint32_t i = 0; i < options_.directions; ++i) {
        Walk walk{first, share};
        while (advance(walk, random, bounces)) {
        }
    }
}

/// What a path meets next, if that can count.
template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
std::optional<SurfacePoint> PathTracer<B, R, V, Rules>::next_point(const Walk& walk,
                                                                   Vec3 direction) const {
    const Ray ray{walk.at.hit.position, direction};
    if constexpr (ShortRayCaster<R>)
        if (walk.bounce == 1) {
            // A little farther, because points are lifted once they are met.
            const float reach = split_.reach(glm::dot(direction, walk.at.surface.normal));
            const float lifted = world_.geometry.view().offset_at(ray.origin);
            return world_.caster.closest_hit(ray, 1.001f * reach + 16.0f * lifted);
        }
    return world_.caster.closest_hit(ray);
}

/// Where a path goes on to. The end of a specular chain, or the first surface.
template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
SpecularEnd PathTracer<B, R, V, Rules>::met_along(const Walk& walk, Vec3 direction,
                                                  Random& random) const {
    SpecularEnd met;
    met.ray = {walk.at.hit.position, direction};
    if (const auto point = next_point(walk, direction)) {
        met.point = *point;
        met.is_background = false;
        SpecularTracer{world_.caster, world_.surfaces.view()}.follow(met, Transport::radiance,
                                                                     random);
    }
    return met;
}

/// One edge further: false when the path is over.
template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
bool PathTracer<B, R, V, Rules>::advance(Walk& walk, Random& random,
                                         std::span<RgbSum> bounces) const {
    const bool last = walk.bounce == options_.max_bounce;
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
        sum_of(bounces, walk.bounce) +=
            walk.throughput * found_environment(walk, sample, met) * walk.share;
        return false;
    }

    Vertex next{LuxelTracer<R, Space::host, B>::hit(met),
                world_.surfaces.surface(met.point, -met.ray.direction)};
    luxels_.weaken(met, next.surface);
    const Rgb found = found_light(walk, sample, met, next);
    sum_of(bounces, walk.bounce) += walk.throughput * found * walk.share;
    if (last || B::is_black(next.surface.bsdf)) return false;
    if (walk.bounce == 1)
        walk.throughput =
            walk.throughput * (met.is_straight ? split_.reflected(hit, surface.normal, next.hit)
                                               : split_.unbounded());
    if (is_black(walk.throughput)) return false;
    walk.at = next;
    ++walk.bounce;
    const Rgb light = sampled_light(walk.at, walk.bounce, random);
    sum_of(bounces, walk.bounce) += walk.throughput * light * walk.share;
    return true;
}

/// Points on emissive triangles that a vertex asks for, and directions towards the environment.
template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
std::uint32_t PathTracer<B, R, V, Rules>::light_samples_at(std::uint32_t bounce) const {
    if (options_.light == LightSearch::directions) return 0;
    return bounce == 1 ? options_.light_samples : 1;
}

/// Scattered directions of a vertex that may find emissive triangles or the environment.
template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
std::uint32_t PathTracer<B, R, V, Rules>::directions_at(std::uint32_t bounce) const {
    const bool any = world_.lights.has_emitters() || !environment_.empty();
    if (options_.light == LightSearch::lamps || !any) return 0;
    return bounce == 1 ? options_.directions : 1;
}

/// Light that the samples of a vertex bring, f cos included, W m^-2 sr^-1.
template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
Rgb PathTracer<B, R, V, Rules>::sampled_light(const Vertex& at, std::uint32_t bounce,
                                              Random& random) const {
    const std::uint32_t samples = light_samples_at(bounce);
    Rgb sum;
    if (world_.lights.has_emitters())
        for (std::uint32_t i = 0; i < samples; ++i) sum += light_sample(at, bounce, random);
    if (!environment_.empty() && is_all_wanted(bounce))
        for (std::uint32_t i = 0; i < samples; ++i) sum += environment_sample(at, bounce, random);
    if (samples > 1) sum = sum * (1.0f / static_cast<float>(samples));
    if (!is_all_wanted(bounce)) return sum;
    return sum + listed_(at.hit, at.surface, [&](std::uint32_t) { return random.next_2d(); });
}

/// Whether a vertex counts light without a bound: lights without extent, the
/// environment.
template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
bool PathTracer<B, R, V, Rules>::is_all_wanted(std::uint32_t bounce) const {
    return bounce > 1 || split_.unbounded() > 0.0f;
}

template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
Rgb PathTracer<B, R, V, Rules>::light_sample(const Vertex& at, std::uint32_t bounce,
                                             Random& random) const {
    const float pick = random.next();
    const EmitterSample lamp = world_.lights.sample_emitter(pick, random.next_2d());
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

template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
Rgb PathTracer<B, R, V, Rules>::environment_sample(const Vertex& at, std::uint32_t bounce,
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
template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
Rgb PathTracer<B, R, V, Rules>::found_environment(const Walk& walk, const BsdfSample& sample,
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
template <Bsdf B, RayCaster R, Visibility V, PathRules Rules>
Rgb PathTracer<B, R, V, Rules>::found_light(const Walk& walk, const BsdfSample& sample,
                                            const SpecularEnd& met, const Vertex& next) const {
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
        Rules::per_steradian(world_.lights.emitter_pdf(point.triangle), d2, cosine);
    return emission * Rules::mis(static_cast<float>(directions) * sample.pdf, sampled);
}

}  // namespace mir
