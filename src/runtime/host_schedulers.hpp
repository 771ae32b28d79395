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

namespace mir {

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

/// Calls use(scheduler) with a host scheduler chosen at run time. Returns what it returns; the
/// image is the same. `monitor` may be null.
template <Executor E, class Use>
auto with_host_scheduler(HostScheduler kind, E& executor, Monitor* monitor, const Use& use) {
    const host::Backend<E> host(executor);
    switch (kind) {
        case HostScheduler::cpu:
            return use(sched::Cpu{executor, monitor});
        case HostScheduler::cpu_blocks:
            break;
        case HostScheduler::os:
            return use(sched::ShadingOnly{host, executor, monitor});
        case HostScheduler::rc:
            return use(sched::Reconstruct{host, monitor});
        case HostScheduler::rcvp:
            return use(sched::ReconstructVisibilityParallel{host, monitor});
    }
    return use(sched::CpuBlocks{executor, monitor});
}

}  // namespace mir
