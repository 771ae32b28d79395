// SPDX-License-Identifier: MIT
#pragma once

#include "mir/sampling/light_path_options.hpp"
#include "mir/sampling/light_walk.hpp"
#include "mir/sampling/survivor_counts.hpp"

namespace mir {

/// What light paths run through, as views.
template <Bsdf B, class R, Space S>
struct LightPathWorld {
    GeometryView<S> geometry;         ///< triangles
    LightTableView<S> lights;         ///< what shines; must not be empty
    SurfaceTableView<S, B> surfaces;  ///< how they reflect
    R caster;                         ///< finds what paths meet, from many threads at once
};

/// Traces one light path of instant radiosity, for host and device. Where it places VPLs is a pure
/// function of options, stream and number of the path. A value of views; const use from any thread.
/// Source: Keller, "Instant radiosity", SIGGRAPH 1997.
template <Bsdf B, class R, Space S>
class LightPathTracer {
 public:
    static_assert(CastsRaysFrom<R, S>,
                  "mir: light paths in a kernel need a ray caster that reads the same memory, such "
                  "as KdRayCaster<Space::device>");

    /// `levels` are read where the options ask for Termination::levels.
    LightPathTracer(const LightPathWorld<B, R, S>& world, const InstantRadiosityOptions& options,
                    SurvivorCountsView levels = {})
        : world_(world), options_(options), levels_(levels) {}

    /// As they were given.
    [[nodiscard]] MIR_HD const InstantRadiosityOptions& options() const { return options_; }

    /// Calls out.add(record, arrival) with each VPL of path `index` of a stream, in their order.
    /// Intensities and powers are those of one path, not yet shared out over their number. Without
    /// InstantRadiosityOptions::arrivals the arrival means nothing.
    template <class Out>
    MIR_HD void operator()(std::uint64_t index, Stream stream, Out& out) const;

 private:
    template <class Out>
    MIR_HD bool bounce_once(Emission& light, std::uint8_t bounce, float survival,
                            PathNumbers& numbers, Out& out) const;
    template <class Out>
    MIR_HD void record(const LightVertex<B>& v, const BsdfSample& sample, std::uint8_t bounce,
                       std::uint16_t light_group, Out& out) const;

    LightPathWorld<B, R, S> world_;
    InstantRadiosityOptions options_;
    SurvivorCountsView levels_;
};

template <Bsdf B, class R, Space S>
template <class Out>
MIR_HD void LightPathTracer<B, R, S>::operator()(std::uint64_t index, Stream stream,
                                                 Out& out) const {
    PathNumbers numbers(options_.sequence, options_.seed, stream, index);
    Emission light = sample_emission(world_.lights, world_.geometry, numbers);
    if (options_.emitter_vpls && light.is_lamp)
        out.add(VplRecord{emitter_vpl(light),
                          {VplKind::emitter, light.emitter.triangle, light.emitter.barycentrics},
                          1,
                          light.light_group},
                VplArrival{});
    for (std::uint8_t bounce = 2; bounce <= options_.max_bounce; ++bounce) {
        float survival = 1.0f;
        if (options_.termination == Termination::levels) {
            const std::uint8_t level = bounce - 1;
            if (index >= levels_.at(level)) break;
            survival = levels_.survival(level);
        }
        if (!bounce_once(light, bounce, survival, numbers, out)) break;
    }
}

template <Bsdf B, class R, Space S>
template <class Out>
MIR_HD bool LightPathTracer<B, R, S>::bounce_once(Emission& light, std::uint8_t bounce,
                                                  float survival, PathNumbers& numbers,
                                                  Out& out) const {
    LightVertex<B> v;
    if (!LightWalk<B, R, S>{world_.surfaces, world_.caster}.next(light, numbers, v)) return false;
    v.at.power = v.at.power * (1.0f / survival);
    const Vec2 uv = numbers.next_2d();
    const BsdfSample sample = B::sample(v.bsdf, v.normal, v.at.towards_light, uv, numbers.next());
    record(v, sample, bounce, light.light_group, out);

    const std::uint16_t group = light.light_group;
    light = scatter(v.at, sample, v.normal);
    light.light_group = group;
    const float roulette = numbers.next();
    if (options_.termination == Termination::levels) return true;
    return survives_roulette(light, sample.weight, roulette);
}

/// Adds the VPL of a vertex. Where its lobe is to be kept, no drawn direction may say that there
/// is none.
template <Bsdf B, class R, Space S>
template <class Out>
MIR_HD void LightPathTracer<B, R, S>::record(const LightVertex<B>& v, const BsdfSample& sample,
                                             std::uint8_t bounce, std::uint16_t light_group,
                                             Out& out) const {
    const SurfacePoint& point = v.at.point;
    const float lobe_share = v.is_through ? 0.0f : world_.surfaces.lobe_share(point.material);
    const Rgb weight = options_.arrivals && lobe_share > 0.0f
                           ? B::albedo(v.bsdf, point.shading_normal, v.at.towards_light)
                           : sample.weight;
    const Vpl vpl = reflective_vpl(v.at, weight);
    if (is_black(vpl.intensity)) return;
    VplArrival arrival;
    if (options_.arrivals)
        arrival = {
            v.at.towards_light, point.shading_normal, v.at.power * v.at.shading_normal_factor(),
            point.material,     attributes_of(point), point.front};
    out.add(VplRecord{vpl,
                      {VplKind::reflective, point.triangle, point.barycentrics},
                      bounce,
                      light_group,
                      1.0f,
                      lobe_share},
            arrival);
}

}  // namespace mir
