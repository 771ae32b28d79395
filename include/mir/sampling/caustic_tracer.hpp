// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/data/extent.hpp"
#include "mir/sampling/light_walk.hpp"
#include "mir/scene/camera_optics.hpp"
#include "mir/scene/light_table.hpp"

#include <algorithm>
#include <vector>

namespace mir {

/// What a light path brings to one luxel.
struct CausticSplat {
    std::uint32_t x = 0;      ///< of the luxel, in the whole luxel image
    std::uint32_t y = 0;      ///< the same
    std::uint8_t bounce = 1;  ///< scattering events of the path, mirrors and glass not counted
    Rgb radiance;             ///< to be added, W m^-2 sr^-1
};

/// Who looks at caustics.
struct CausticView {
    CameraOptics optics;  ///< of the camera
    float aspect = 1.0f;  ///< width / height of the film
    Extent luxels;        ///< of the whole luxel image
};

/// Which light paths a CausticTracer traces.
struct CausticPaths {
    std::uint64_t paths = 0;               ///< how many
    std::uint8_t max_bounce = 32;          ///< largest number of scattering events
    Sequence sequence = Sequence::random;  ///< numbers that they are made of
    std::uint64_t seed = 0;                ///< of the numbers
};

/// Light that reaches a luxel's surface from a mirror or through a body of glass, and that neither
/// VPLs nor light samples bring. Light paths are seen by the camera where their last edge is such a
/// chain. Unbiased. What the camera itself sees in mirrors or through bodies is another part: paths
/// that are traced back bring it (PathPart::residual). Source: the light tracing of Arvo, "Backward
/// ray tracing", SIGGRAPH 1986 courses.
template <Bsdf B, RayCaster R, Visibility V>
class CausticTracer {
 public:
    /// The scene data must outlive it.
    CausticTracer(const LightTable& lights, LightWalk<B, R> walk, V visibility,
                  const CausticView& view)
        : lights_(lights), walk_(walk), visibility_(visibility), view_(view) {}

    /// Splats of all paths, in their order. A function of the options alone.
    template <Executor E>
    [[nodiscard]] std::vector<CausticSplat> trace(const CausticPaths& options, E& executor) const {
        return trace(options, 0, options.paths, executor);
    }
    /// The same of the paths from `first` to before `last` alone.
    template <Executor E>
    [[nodiscard]] std::vector<CausticSplat> trace(const CausticPaths& options, std::uint64_t first,
                                                  std::uint64_t last, E& executor) const;

 private:
    static constexpr std::uint64_t batch = 1024;

    void trace(std::uint64_t index, const CausticPaths& options,
               std::vector<CausticSplat>& out) const;
    void splat(const LightVertex<B>& v, std::uint8_t bounce, Vec2 lens, double paths,
               std::vector<CausticSplat>& out) const;

    const LightTable& lights_;
    LightWalk<B, R> walk_;
    V visibility_;
    CausticView view_;
};

template <Bsdf B, RayCaster R, Visibility V>
template <Executor E>
std::vector<CausticSplat> CausticTracer<B, R, V>::trace(const CausticPaths& options,
                                                        std::uint64_t first, std::uint64_t last,
                                                        E& executor) const {
    if (lights_.empty()) return {};
    std::vector<std::vector<CausticSplat>> parts((last - first + batch - 1) / batch);
    executor.for_each(parts.size(), [&](std::size_t b) {
        const std::uint64_t end = std::min<std::uint64_t>(first + (b + 1) * batch, last);
        for (std::uint64_t i = first + b * batch; i < end; ++i) trace(i, options, parts[b]);
    });
    std::vector<CausticSplat> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

template <Bsdf B, RayCaster R, Visibility V>
void CausticTracer<B, R, V>::trace(std::uint64_t index, const CausticPaths& options,
                                   std::vector<CausticSplat>& out) const {
    PathNumbers numbers(options.sequence, options.seed, Stream::caustic, index);
    Emission light = sample_emission(lights_, numbers);
    for (std::uint8_t bounce = 1; bounce <= options.max_bounce; ++bounce) {
        LightVertex<B> v;
        if (!walk_.next(light, numbers, v)) return;
        const Vec2 lens = view_.optics.lens_radius > 0.0f ? numbers.next_2d() : Vec2(0.0f);
        if (!v.is_straight) splat(v, bounce, lens, static_cast<double>(options.paths), out);
        const Vec2 uv = numbers.next_2d();
        const BsdfSample sample =
            B::sample(v.bsdf, v.normal, v.at.towards_light, uv, numbers.next());
        light = scatter(v.at, sample, v.normal);
        if (!survives_roulette(light, sample.weight, numbers.next())) return;
    }
}

/// Shows a vertex to the camera, with the shading normal of a luxel there.
template <Bsdf B, RayCaster R, Visibility V>
void CausticTracer<B, R, V>::splat(const LightVertex<B>& v, std::uint8_t bounce, Vec2 lens,
                                   double paths, std::vector<CausticSplat>& out) const {
    const SurfacePoint& p = v.at.point;
    const Vec3 place = lift(p);
    const FilmPoint seen = view_.optics.project(place, view_.aspect, lens);
    if (!seen.is_on_film()) return;
    const Vec3 to_lens = seen.from - place;
    const float d2 = length_squared(to_lens);
    const Vec3 wo = to_lens * (1.0f / std::sqrt(d2));
    const float cosine = glm::dot(wo, p.geometric_normal);
    if (!(cosine > 0.0f)) return;
    const Vec3 normal = walk_.surfaces.seen_normal(p, wo);
    if (!(glm::dot(v.at.towards_light, normal) > 0.0f)) return;
    const Rgb f = B::eval(v.bsdf, normal, v.at.towards_light, wo);
    if (is_black(f) || !visibility_.visible(place, seen.from)) return;
    const Extent luxels = view_.luxels;
    const double density = static_cast<double>(cosine * seen.per_steradian / d2) *
                           static_cast<double>(luxels.area()) / paths;
    const auto cell = [](float at, std::uint32_t n) {
        return std::min(static_cast<std::uint32_t>(at * static_cast<float>(n)), n - 1);
    };
    out.push_back({cell(seen.film.x, luxels.width), cell(seen.film.y, luxels.height), bounce,
                   f * v.at.power * (v.at.shading_normal_factor() * static_cast<float>(density))});
}

}  // namespace mir
