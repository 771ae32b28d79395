// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/sampler.hpp"
#include "mir/core/limits.hpp"
#include "mir/sampling/light_path_options.hpp"
#include "mir/sampling/light_walk.hpp"
#include "mir/sampling/survivor_counts.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace mir {

/// How many VPLs an InstantRadiositySampler wants, from what numbers, and where paths end.
struct InstantRadiosityOptions {
    std::uint32_t vpls = 256;                         ///< wanted; the set comes close, see sample()
    Termination termination = Termination::roulette;  ///< when paths end
    Sequence sequence = Sequence::random;             ///< numbers that paths are made of
    bool emitter_vpls = false;     ///< also place VPLs on the lamps: direct light by VPLs
    std::uint8_t max_bounce = 32;  ///< largest number of scattering events, 1..254
    /// Also keep how light arrives at VPLs (VplRecords::arrivals). The intensity of a VPL that is
    /// not Lambertian is then a guide alone, by Bsdf::albedo(): its light is that of the lobe.
    bool arrivals = false;
    std::uint64_t seed = 0;  ///< of all numbers, the pilot's too
};

/// Instant radiosity: VPLs along light paths that start at the lamps. Source: Keller, "Instant
/// radiosity", SIGGRAPH 1997; without emitter VPLs, the variant of section 3 of Pajot, Barthe and
/// Paulin 2009, in which level n gets floor(rho^(n-1) N) VPLs. Model of Sampler. The referenced
/// scene data must outlive it; const use from any thread.
template <Bsdf B, RayCaster R>
class InstantRadiositySampler {
 public:
    static constexpr Normalisation normalisation = Normalisation::none;  ///< intensities are J

    /// What paths run through.
    struct World {
        const WorldGeometry& geometry;    ///< outlives the sampler
        const LightTable& lights;         ///< outlives the sampler; may be empty: no records
        const SurfaceTable<B>& surfaces;  ///< outlives the sampler
        R caster;                         ///< finds what paths meet, from many threads at once
    };

    /// @throws Error(invalid_argument) when options are out of range. Error(limit_exceeded) when
    /// more VPLs are wanted than `limits` allows.
    InstantRadiositySampler(const World& world, InstantRadiosityOptions options,
                            const Limits& limits = {})
        : world_(world), options_(options) {
        expects(options.vpls > 0,
                "0 VPLs were asked for (there would be no light); ask for at "
                "least 1, 256 is usual");
        expects(options.max_bounce >= 1 && options.max_bounce < 255,
                "the largest bounce must be 1 to 254");
        check_limit(options.vpls, limits.vpls, "vpls");
    }

    /// Traces the paths. Their number is fixed beforehand, so that nothing depends on where the
    /// count of VPLs happens to stop: by a pilot run with numbers of its own for roulette, from rho
    /// for levels. The number of records therefore only comes close to options.vpls.
    template <Executor E>
    [[nodiscard]] VplRecords sample(E& executor) const;

 private:
    /// What neighbouring paths leave, one path after the other.
    struct Paths {
        std::vector<VplRecord> records;
        std::vector<VplArrival> arrivals;
        std::size_t first = 0;  ///< record, among those of all paths
    };
    static constexpr std::uint64_t together = 64;  ///< paths that one task traces

    template <Executor E>
    [[nodiscard]] std::vector<Paths> trace(std::uint64_t count, Stream stream,
                                           const SurvivorCounts* levels, E& executor) const;
    template <Executor E>
    void join(std::span<const Paths> all, E& executor, VplRecords& out) const;
    template <Executor E>
    [[nodiscard]] std::uint64_t paths_for_target(E& executor) const;
    void trace_path(std::uint64_t index, Stream stream, const SurvivorCounts* levels,
                    Paths& path) const;
    bool bounce_once(Emission& light, std::uint8_t bounce, float survival, PathNumbers& numbers,
                     Paths& path) const;
    void record(const Arrival<B>& at, const typename B::Params& bsdf, const BsdfSample& sample,
                std::uint8_t bounce, std::uint16_t light_group, Paths& path) const;
    [[nodiscard]] SurvivorCounts level_counts() const;

    World world_;
    InstantRadiosityOptions options_;
};

template <Bsdf B, RayCaster R>
template <Executor E>
VplRecords InstantRadiositySampler<B, R>::sample(E& executor) const {
    VplRecords out;
    out.emitted_power = static_cast<float>(world_.lights.power());
    if (world_.lights.empty()) return out;
    const bool levels = options_.termination == Termination::levels;
    const SurvivorCounts counts = levels ? level_counts() : SurvivorCounts{};
    out.paths = levels ? counts.at(0) : paths_for_target(executor);
    join(trace(out.paths, Stream::light_path, levels ? &counts : nullptr, executor), executor, out);
    out.non_lambertian_share = share_of_non_lambertian(out.records);
    return out;
}

/// Paths 0 to count - 1, in their order.
template <Bsdf B, RayCaster R>
template <Executor E>
auto InstantRadiositySampler<B, R>::trace(std::uint64_t count, Stream stream,
                                          const SurvivorCounts* levels, E& executor) const
    -> std::vector<Paths> {
    std::vector<Paths> all((count + together - 1) / together);
    executor.for_each(all.size(), [&](std::size_t k) {
        const std::uint64_t end = std::min(count, (k + 1) * together);
        for (std::uint64_t i = k * together; i < end; ++i) trace_path(i, stream, levels, all[k]);
    });
    std::size_t before = 0;
    for (Paths& some : all) {
        some.first = before;
        before += some.records.size();
    }
    return all;
}

/// Writes all records, each path's power shared out over the number of paths.
template <Bsdf B, RayCaster R>
template <Executor E>
void InstantRadiositySampler<B, R>::join(std::span<const Paths> all, E& executor,
                                         VplRecords& out) const {
    if (all.empty()) return;
    const std::size_t records = all.back().first + all.back().records.size();
    out.records.resize(records);
    if (options_.arrivals) out.arrivals.resize(records);
    const float scale = 1.0f / static_cast<float>(out.paths);
    executor.for_each(all.size(), [&](std::size_t k) {
        const Paths& some = all[k];
        for (std::size_t i = 0; i < some.records.size(); ++i) {
            VplRecord& record = out.records[some.first + i];
            record = some.records[i];
            record.vpl.intensity = record.vpl.intensity * scale;
            if (!options_.arrivals) continue;
            VplArrival& arrival = out.arrivals[some.first + i];
            arrival = some.arrivals[i];
            arrival.power = arrival.power * scale;
        }
    });
}

template <Bsdf B, RayCaster R>
template <Executor E>
std::uint64_t InstantRadiositySampler<B, R>::paths_for_target(E& executor) const {
    constexpr std::uint64_t pilot_paths = 4096;
    const std::vector<Paths> pilot = trace(pilot_paths, Stream::pilot, nullptr, executor);
    const std::uint64_t records = pilot.back().first + pilot.back().records.size();
    // Nothing hit at all: the target cannot be met, so the count of paths is the target itself.
    const double per_path =
        records == 0 ? 1.0 : static_cast<double>(records) / static_cast<double>(pilot_paths);
    return std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(std::llround(options_.vpls / per_path)));
}

template <Bsdf B, RayCaster R>
SurvivorCounts InstantRadiositySampler<B, R>::level_counts() const {
    double area = 0.0;
    double reflected = 0.0;
    for (std::uint32_t t = 0; t < world_.geometry.triangles().size(); ++t) {
        const double a = world_.geometry.area(t);
        area += a;
        reflected += a * world_.surfaces.mean_albedo(world_.geometry.material_of(t));
    }
    const double rho = area > 0.0 ? reflected / area : 0.0;
    // The lamp is level 0 and bounce 1.
    const auto max_level = static_cast<std::uint8_t>(options_.max_bounce - 1);
    return SurvivorCounts::for_total(options_.vpls, rho, max_level, options_.emitter_vpls);
}

/// Adds the VPL of an arrival. Where its lobe is to be kept, no drawn direction may say that there
/// is none.
template <Bsdf B, RayCaster R>
void InstantRadiositySampler<B, R>::record(const Arrival<B>& at, const typename B::Params& bsdf,
                                           const BsdfSample& sample, std::uint8_t bounce,
                                           std::uint16_t light_group, Paths& path) const {
    const SurfacePoint& point = at.point;
    const float lobe_share = world_.surfaces.view().lobe_share(point.material);
    const Rgb weight = options_.arrivals && lobe_share > 0.0f
                           ? B::albedo(bsdf, point.shading_normal, at.towards_light)
                           : sample.weight;
    const Vpl vpl = reflective_vpl(at, weight);
    if (is_black(vpl.intensity)) return;
    path.records.push_back({vpl,
                            {VplKind::reflective, point.triangle, point.barycentrics},
                            bounce,
                            light_group,
                            1.0f,
                            lobe_share});
    if (options_.arrivals)
        path.arrivals.push_back({at.towards_light, point.shading_normal,
                                 at.power * at.shading_normal_factor(), point.material,
                                 attributes_of(point), point.front});
}

template <Bsdf B, RayCaster R>
void InstantRadiositySampler<B, R>::trace_path(std::uint64_t index, Stream stream,
                                               const SurvivorCounts* levels, Paths& path) const {
    PathNumbers numbers(options_.sequence, options_.seed, stream, index);
    Emission light = sample_emission(world_.lights, numbers);
    if (options_.emitter_vpls && light.emitter) {
        path.records.push_back(
            {emitter_vpl(light),
             {VplKind::emitter, light.emitter->triangle, light.emitter->barycentrics},
             1,
             light.light_group});
        if (options_.arrivals) path.arrivals.emplace_back();
    }
    for (std::uint8_t bounce = 2; bounce <= options_.max_bounce; ++bounce) {
        float survival = 1.0f;
        if (levels != nullptr) {
            const std::uint8_t level = bounce - 1;
            if (index >= levels->at(level)) break;
            survival = levels->survival(level);
        }
        if (!bounce_once(light, bounce, survival, numbers, path)) break;
    }
}

template <Bsdf B, RayCaster R>
bool InstantRadiositySampler<B, R>::bounce_once(Emission& light, std::uint8_t bounce,
                                                float survival, PathNumbers& numbers,
                                                Paths& path) const {
    auto v = LightWalk<B, R>{world_.surfaces.view(), world_.caster}.next(light, numbers);
    if (!v) return false;
    v->at.power = v->at.power * (1.0f / survival);
    const Vec2 uv = numbers.next_2d();
    const BsdfSample sample =
        B::sample(v->bsdf, v->normal, v->at.towards_light, uv, numbers.next());
    record(v->at, v->bsdf, sample, bounce, light.light_group, path);

    const std::uint16_t group = light.light_group;
    light = scatter(v->at, sample, v->normal);
    light.light_group = group;
    const float roulette = numbers.next();
    if (options_.termination == Termination::levels) return true;
    return survives_roulette(light, sample.weight, roulette);
}

}  // namespace mir
