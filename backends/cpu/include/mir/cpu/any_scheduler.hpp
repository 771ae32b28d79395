// SPDX-License-Identifier: MIT
#pragma once

#include "mir/host/backend.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/sched/reconstruct.hpp"
#include "mir/sched/reconstruct_visibility_parallel.hpp"
#include "mir/sched/shading_only.hpp"

#include <array>
#include <string_view>
#include <utility>
#include <variant>

namespace mir::cpu {

/// The schedulers that run on the host.
enum class HostScheduler { cpu, cpu_blocks, os, rc, rcvp };

/// Their names in the Registry.
inline constexpr std::array<std::pair<std::string_view, HostScheduler>, 5> host_schedulers{{
    {"cpu", HostScheduler::cpu},
    {"cpu-blocks", HostScheduler::cpu_blocks},
    {"os", HostScheduler::os},
    {"rc", HostScheduler::rc},
    {"rcvp", HostScheduler::rcvp},
}};

/// A scheduler of the host that is chosen while the program runs; the image is the same.
template <Executor E>
struct AnyScheduler {
    HostScheduler kind;          ///< which of the schedulers
    E& executor;                 ///< of all of them; host backends run on it too
    Monitor* monitor = nullptr;  ///< may be null

    /// Model of mir::Pipeline for one image; what it is given must outlive it.
    template <class In>
    class Pipeline {
     public:
        /// Opens the pipeline of the kind that was chosen, on a scheduler of its own.
        /// @throws What that pipeline throws.
        Pipeline(const In& in, Image<Rgb>& image, const AnyScheduler& chosen)
            : schedulers_(chosen), pipeline_(open(in, image, chosen.kind)) {}
        Pipeline(const Pipeline&) = delete;
        Pipeline& operator=(const Pipeline&) = delete;
        ~Pipeline() = default;

        /// As that pipeline does.
        void submit(TileIndex t) {
            std::visit([t](auto& p) { p.submit(t); }, pipeline_);
        }
        /// As that pipeline does.
        void finish() {
            std::visit([](auto& p) { p.finish(); }, pipeline_);
        }

     private:
        /// One of each; pipelines refer to theirs.
        struct Schedulers {
            explicit Schedulers(const AnyScheduler& s)
                : cpu{s.executor, s.monitor},
                  blocks{s.executor, s.monitor},
                  os{host::Backend<E>(s.executor), s.executor, s.monitor},
                  rc{host::Backend<E>(s.executor), s.monitor},
                  rcvp{host::Backend<E>(s.executor), s.monitor} {}

            sched::Cpu<E> cpu;
            sched::CpuBlocks<E> blocks;
            sched::ShadingOnly<host::Backend<E>, E> os;
            sched::Reconstruct<host::Backend<E>> rc;
            sched::ReconstructVisibilityParallel<host::Backend<E>> rcvp;
        };
        using Any = std::variant<
            typename sched::Cpu<E>::template Pipeline<In>,
            typename sched::CpuBlocks<E>::template Pipeline<In>,
            typename sched::ShadingOnly<host::Backend<E>, E>::template Pipeline<In>,
            typename sched::Reconstruct<host::Backend<E>>::template Pipeline<In>,
            typename sched::ReconstructVisibilityParallel<host::Backend<E>>::template Pipeline<In>>;

        [[nodiscard]] Any open(const In& in, Image<Rgb>& image, HostScheduler chosen) const {
            switch (chosen) {
                case HostScheduler::cpu:
                    return schedulers_.cpu.open(in, image);
                case HostScheduler::cpu_blocks:
                    return schedulers_.blocks.open(in, image);
                case HostScheduler::os:
                    return schedulers_.os.open(in, image);
                case HostScheduler::rc:
                    return schedulers_.rc.open(in, image);
                case HostScheduler::rcvp:
                    break;
            }
            return schedulers_.rcvp.open(in, image);
        }

        Schedulers schedulers_;
        Any pipeline_;
    };

    /// A pipeline for one image, whose size is that of the G-buffer.
    template <class In>
    Pipeline<In> open(const In& in, Image<Rgb>& image) const {
        return {in, image, *this};
    }
};
template <Executor E>
AnyScheduler(HostScheduler, E&) -> AnyScheduler<E>;
template <Executor E>
AnyScheduler(HostScheduler, E&, Monitor*) -> AnyScheduler<E>;

}  // namespace mir::cpu
