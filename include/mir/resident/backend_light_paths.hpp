// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/resident/uploaded_array.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "mir/sampling/light_path_tracer.hpp"
#include "mir/sampling/run_light_paths.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

namespace mir {

/// Kernel over light paths: how many VPLs each places.
template <class Tracer>
struct CountLightPaths {
    Tracer tracer;                    ///< a LightPathTracer
    Stream stream;                    ///< of the paths
    std::uint64_t first = 0;          ///< path
    std::uint32_t* counts = nullptr;  ///< written, by path

    /// Path first + i.
    MIR_HD void operator()(std::uint32_t i) const {
        Counter counter;
        tracer(first + i, stream, counter);
        counts[i] = counter.records;
    }

 private:
    struct Counter {
        std::uint32_t records = 0;

        MIR_HD void add(const VplRecord& /*record*/, const VplArrival& /*arrival*/) { ++records; }
    };
};

/// Kernel over light paths: writes the VPLs that CountLightPaths counted. Their power is shared out
/// over all paths.
template <class Tracer>
struct WriteLightPaths {
    Tracer tracer;                          ///< a LightPathTracer
    std::uint64_t first = 0;                ///< path
    float scale = 1.0f;                     ///< 1 / paths
    const std::uint32_t* places = nullptr;  ///< of each path's first record in `records`
    VplRecord* records = nullptr;           ///< written

    /// Path first + i.
    MIR_HD void operator()(std::uint32_t i) const {
        Writer writer{records + places[i], scale};
        tracer(first + i, Stream::light_path, writer);
    }

 private:
    struct Writer {
        VplRecord* to;
        float scale;

        MIR_HD void add(const VplRecord& record, const VplArrival& /*arrival*/) {
            *to = record;
            to->vpl.intensity = record.vpl.intensity * scale;
            ++to;
        }
    };
};

/// InstantRadiositySampler on a backend: each path is traced twice, to count its VPLs and to write
/// them. Same records, in every bit, as InstantRadiositySampler over the same scene and ray caster,
/// where neither compiler fuses products (docs/embedding.md). It keeps no arrivals. Const use by
/// one thread per queue.
template <Backend B, Bsdf F, class R>
class BackendLightPaths {
 public:
    /// What paths run through, in the backend's memory.
    using World = LightPathWorld<F, R, B::space>;

    /// What `world` views must outlive it.
    /// @throws Error(invalid_argument) when options are out of range or ask for arrivals.
    /// Error(limit_exceeded) when more VPLs are wanted than `limits` allows.
    BackendLightPaths(const B& backend, const World& world, const InstantRadiosityOptions& options,
                      const Limits& limits = {})
        : backend_(backend), world_(world), options_(options) {
        check_light_paths(options, limits);
        expects(!options.arrivals,
                "light paths in a backend's memory were asked how light arrives at VPLs (they do "
                "not keep that); sample on the host");
    }

    /// Traces the paths; all work is done when it returns or throws. `lights` and `surfaces` are
    /// those of the world, on the host. `monitor` may be null.
    /// @throws Error(cancelled) between kernels; what the backend throws.
    [[nodiscard]] VplRecords sample(typename B::Queue& queue, const LightTable& lights,
                                    const SurfaceTable<F>& surfaces,
                                    Monitor* monitor = nullptr) const {
        Machine machine{*this, queue, monitor};
        return run_light_paths(options_, lights, surfaces, machine);
    }

 private:
    using Tracer = LightPathTracer<F, R, B::space>;
    static constexpr std::uint64_t at_a_time = std::uint64_t{1} << 20;  ///< paths of a kernel

    struct Machine {
        const BackendLightPaths& sampler;
        typename B::Queue& queue;
        Monitor* monitor;

        [[nodiscard]] std::uint64_t count(std::uint64_t paths) const {
            const auto counts = sampler.count(queue, Tracer(sampler.world_, sampler.options_),
                                              Stream::pilot, 0, static_cast<std::uint32_t>(paths));
            return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
        }
        void trace(const SurvivorCounts& levels, VplRecords& out) const {
            sampler.trace(queue, monitor, levels, out);
        }
    };

    [[nodiscard]] std::vector<std::uint32_t> count(typename B::Queue& queue, const Tracer& tracer,
                                                   Stream stream, std::uint64_t first,
                                                   std::uint32_t paths) const;
    void trace(typename B::Queue& queue, Monitor* monitor, const SurvivorCounts& levels,
               VplRecords& out) const;

    B backend_;
    World world_;
    InstantRadiosityOptions options_;
};

template <Backend B, Bsdf F, class R>
std::vector<std::uint32_t> BackendLightPaths<B, F, R>::count(typename B::Queue& queue,
                                                             const Tracer& tracer, Stream stream,
                                                             std::uint64_t first,
                                                             std::uint32_t paths) const {
    auto there = backend_.template buffer<std::uint32_t>(paths);
    std::vector<std::uint32_t> here(paths);
    const WaitAtEnd wait(queue);
    queue.for_each(paths, CountLightPaths<Tracer>{tracer, stream, first, there.data()});
    queue.download(there, std::span(here));
    queue.record().sync();
    return here;
}

template <Backend B, Bsdf F, class R>
void BackendLightPaths<B, F, R>::trace(typename B::Queue& queue, Monitor* monitor,
                                       const SurvivorCounts& levels, VplRecords& out) const {
    const UploadedArray<B, std::uint64_t> levels_there(backend_, queue, levels.counts());
    const Tracer tracer(world_, options_,
                        {levels_there.data(), static_cast<std::uint32_t>(levels_there.size())});
    const float scale = 1.0f / static_cast<float>(out.paths);
    const WaitAtEnd wait(queue);
    for (std::uint64_t first = 0; first < out.paths; first += at_a_time) {
        if (monitor != nullptr) monitor->check();
        const auto paths = static_cast<std::uint32_t>(std::min(at_a_time, out.paths - first));
        std::vector<std::uint32_t> places = count(queue, tracer, Stream::light_path, first, paths);
        const std::uint32_t last = places.back();
        std::exclusive_scan(places.begin(), places.end(), places.begin(), 0u);
        const std::size_t records = std::size_t{places.back()} + last;
        if (records == 0) continue;
        const UploadedArray<B, std::uint32_t> places_there(backend_, queue, places);
        auto there = backend_.template buffer<VplRecord>(records);
        // What lies between members is copied home too.
        queue.clear(there);
        queue.for_each(paths, WriteLightPaths<Tracer>{tracer, first, scale, places_there.data(),
                                                      there.data()});
        out.records.resize(out.records.size() + records);
        queue.download(there, std::span(out.records).last(records));
        queue.record().sync();
    }
}

}  // namespace mir
