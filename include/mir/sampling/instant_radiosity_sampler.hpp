// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/sampler.hpp"
#include "mir/sampling/light_path_tracer.hpp"
#include "mir/sampling/run_light_paths.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

namespace mir {

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
        check_light_paths(options, limits);
    }

    /// Traces the paths: run_light_paths().
    template <Executor E>
    [[nodiscard]] VplRecords sample(E& executor) const {
        Machine<E> machine{*this, executor};
        return run_light_paths(options_, world_.lights, world_.surfaces, machine);
    }

 private:
    using Tracer = LightPathTracer<B, R, Space::host>;
    static constexpr std::uint64_t together = 64;  ///< paths that one task traces

    /// What neighbouring paths leave, one path after the other.
    struct Paths {
        std::vector<VplRecord> records;
        std::vector<VplArrival> arrivals;
        bool keep_arrivals = false;
        std::size_t first = 0;  ///< record, among those of all paths

        void add(const VplRecord& record, const VplArrival& arrival) {
            records.push_back(record);
            if (keep_arrivals) arrivals.push_back(arrival);
        }
    };
    struct Counter {
        std::uint64_t records = 0;

        void add(const VplRecord& /*record*/, const VplArrival& /*arrival*/) { ++records; }
    };

    template <class E>
    struct Machine {
        const InstantRadiositySampler& sampler;
        E& executor;

        [[nodiscard]] std::uint64_t count(std::uint64_t paths) const {
            const auto parts = sampler.template trace<Counter>({}, paths, Stream::pilot, executor);
            return std::accumulate(
                parts.begin(), parts.end(), std::uint64_t{0},
                [](std::uint64_t sum, const Counter& part) { return sum + part.records; });
        }
        void trace(const SurvivorCounts& levels, VplRecords& out) const {
            auto parts =
                sampler.template trace<Paths>(levels, out.paths, Stream::light_path, executor);
            sampler.join(parts, executor, out);
        }
    };

    template <class Out, Executor E>
    [[nodiscard]] std::vector<Out> trace(const SurvivorCounts& levels, std::uint64_t count,
                                         Stream stream, E& executor) const;
    template <Executor E>
    void join(std::span<Paths> all, E& executor, VplRecords& out) const;

    World world_;
    InstantRadiosityOptions options_;
};

/// Paths 0 to count - 1, in their order.
template <Bsdf B, RayCaster R>
template <class Out, Executor E>
auto InstantRadiositySampler<B, R>::trace(const SurvivorCounts& levels, std::uint64_t count,
                                          Stream stream, E& executor) const -> std::vector<Out> {
    const Tracer tracer(
        {world_.geometry.view(), world_.lights.view(), world_.surfaces.view(), world_.caster},
        options_, levels.view());
    std::vector<Out> all((count + together - 1) / together);
    executor.for_each(all.size(), [&](std::size_t k) {
        if constexpr (requires { all[k].keep_arrivals; }) all[k].keep_arrivals = options_.arrivals;
        const std::uint64_t end = std::min(count, (k + 1) * together);
        for (std::uint64_t i = k * together; i < end; ++i) tracer(i, stream, all[k]);
    });
    return all;
}

/// Writes all records, each path's power shared out over the number of paths.
template <Bsdf B, RayCaster R>
template <Executor E>
void InstantRadiositySampler<B, R>::join(std::span<Paths> all, E& executor, VplRecords& out) const {
    std::size_t records = 0;
    for (Paths& some : all) {
        some.first = records;
        records += some.records.size();
    }
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

}  // namespace mir
