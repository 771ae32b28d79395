// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/sampling/caustic_paths.hpp"
#include "mir/sampling/light_walk.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/shading/sampled_light.hpp"

#include <algorithm>
#include <vector>

namespace mir {

/// Light that reaches a luxel's surface from a mirror or through a body of glass, and that neither
/// VPLs nor light samples bring. Light paths are seen by the camera where their last edge is such a
/// chain. Unbiased. What the camera itself sees in mirrors or through bodies is another part: paths
/// that are traced back bring it (PathPart::residual). Source: the light tracing of Arvo, "Backward
/// ray tracing", SIGGRAPH 1986 courses. A value of views for host and device; what they read must
/// outlive it. Const use from any thread.
template <Bsdf B, class R, Visibility V>
class CausticTracer {
 public:
    static constexpr Space space = space_of_lights<V>;  ///< memory that the views read

    /// What shines must be something.
    CausticTracer(const LightTableView<space>& lights, const GeometryView<space>& geometry,
                  LightWalk<B, R, space> walk, V visibility, const CausticView& view)
        : lights_(lights), geometry_(geometry), walk_(walk), visibility_(visibility), view_(view) {}
    /// Of the lights of the host.
    CausticTracer(const LightTable& lights, LightWalk<B, R, Space::host> walk, V visibility,
                  const CausticView& view) requires(space == Space::host)
        : CausticTracer(lights.view(), lights.geometry().view(), walk, visibility, view) {}

    /// Calls out.add(splat) with all that path `index` brings to luxels, its power shared out over
    /// options.paths.
    template <class Out>
    MIR_HD void operator()(std::uint64_t index, const CausticPaths& options, Out& out) const;

 private:
    template <class Out>
    MIR_HD void splat(const LightVertex<B>& v, std::uint8_t bounce, Vec2 lens, double paths,
                      Out& out) const;

    LightTableView<space> lights_;
    GeometryView<space> geometry_;
    LightWalk<B, R, space> walk_;
    V visibility_;
    CausticView view_;
};
template <class B, class R, Visibility V>
CausticTracer(const LightTable&, LightWalk<B, R, Space::host>, V, CausticView)
    -> CausticTracer<B, R, V>;

/// Splats of the paths from `first` to before `last`, in their order. A function of the options
/// alone.
template <Bsdf B, class R, Visibility V, Executor E>
[[nodiscard]] std::vector<CausticSplat> trace_caustics(const CausticTracer<B, R, V>& tracer,
                                                       const CausticPaths& options,
                                                       std::uint64_t first, std::uint64_t last,
                                                       E& executor) {
    struct Splats {
        std::vector<CausticSplat> all;

        void add(const CausticSplat& splat) { all.push_back(splat); }
    };
    constexpr std::uint64_t batch = 1024;
    std::vector<Splats> parts((last - first + batch - 1) / batch);
    executor.for_each(parts.size(), [&](std::size_t b) {
        const std::uint64_t end = std::min<std::uint64_t>(first + (b + 1) * batch, last);
        for (std::uint64_t i = first + b * batch; i < end; ++i) tracer(i, options, parts[b]);
    });
    std::vector<CausticSplat> all;
    for (const Splats& part : parts) all.insert(all.end(), part.all.begin(), part.all.end());
    return all;
}

template <Bsdf B, class R, Visibility V>
template <class Out>
MIR_HD void CausticTracer<B, R, V>::operator()(std::uint64_t index, const CausticPaths& options,
                                               Out& out) const {
    PathNumbers numbers(options.sequence, options.seed, Stream::caustic, index);
    Emission light = sample_emission(lights_, geometry_, numbers);
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
template <Bsdf B, class R, Visibility V>
template <class Out>
MIR_HD void CausticTracer<B, R, V>::splat(const LightVertex<B>& v, std::uint8_t bounce, Vec2 lens,
                                          double paths, Out& out) const {
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
                           (static_cast<double>(luxels.width) * luxels.height) / paths;
    const auto cell = [](float at, std::uint32_t n) {
        const auto i = static_cast<std::uint32_t>(at * static_cast<float>(n));
        return i < n ? i : n - 1;
    };
    out.add(CausticSplat{
        cell(seen.film.x, luxels.width), cell(seen.film.y, luxels.height), bounce,
        f * v.at.power * (v.at.shading_normal_factor() * static_cast<float>(density))});
}

}  // namespace mir
