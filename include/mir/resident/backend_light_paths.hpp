// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/resident/append_outputs.hpp"
#include "mir/sampling/light_path_tracer.hpp"
#include "mir/sampling/run_light_paths.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace mir {

/// Item of append_outputs(): a light path, whose outputs are its VPLs.
template <class Tracer>
struct LightPathOutputs {
    Tracer tracer;            ///< a LightPathTracer
    Stream stream;            ///< of the paths
    std::uint64_t first = 0;  ///< path of item 0
    float scale = 1.0f;       ///< of intensities

    /// Calls out.add(record) for each VPL of path first + i.
    template <class Out>
    MIR_HD void operator()(std::uint32_t i, Out& out) const {
        Scaled<Out> scaled{out, scale};
        tracer(first + i, stream, scaled);
    }

 private:
    template <class Out>
    struct Scaled {
        Out& out;
        float scale;

        MIR_HD void add(const VplRecord& record, const VplArrival& /*arrival*/) {
            VplRecord own = record;
            own.vpl.intensity = record.vpl.intensity * scale;
            out.add(own);
        }
    };
};

/// InstantRadiositySampler on a backend. Same records, in every bit, as InstantRadiositySampler
/// over the same scene and ray caster, where neither compiler fuses products (docs/embedding.md).
/// It keeps no arrivals. Const use by one thread per queue.
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
            const auto counts = count_outputs(
                sampler.backend_, queue, static_cast<std::uint32_t>(paths),
                LightPathOutputs<Tracer>{{sampler.world_, sampler.options_}, Stream::pilot});
            return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
        }
        void trace(const SurvivorCounts& levels, VplRecords& out) const {
            sampler.trace(queue, monitor, levels, out);
        }
    };

    void trace(typename B::Queue& queue, Monitor* monitor, const SurvivorCounts& levels,
               VplRecords& out) const;

    B backend_;
    World world_;
    InstantRadiosityOptions options_;
};

template <Backend B, Bsdf F, class R>
void BackendLightPaths<B, F, R>::trace(typename B::Queue& queue, Monitor* monitor,
                                       const SurvivorCounts& levels, VplRecords& out) const {
    const UploadedArray<B, std::uint64_t> levels_there(backend_, queue, levels.counts());
    const Tracer tracer(world_, options_,
                        {levels_there.data(), static_cast<std::uint32_t>(levels_there.size())});
    const float scale = 1.0f / static_cast<float>(out.paths);
    for (std::uint64_t first = 0; first < out.paths; first += at_a_time) {
        if (monitor != nullptr) monitor->check();
        const auto paths = static_cast<std::uint32_t>(std::min(at_a_time, out.paths - first));
        append_outputs(backend_, queue, paths,
                       LightPathOutputs<Tracer>{tracer, Stream::light_path, first, scale},
                       out.records);
    }
}

}  // namespace mir
