// SPDX-License-Identifier: MIT
#include "runtime/host_tracing.hpp"

#include "mir/runtime/cancellable_executor.hpp"
#include "runtime/traced_scene.hpp"

#include <algorithm>
#include <cmath>

namespace mir {
namespace {

/// Luxels times VPLs from which shafts save more than our slower build costs. Embree
/// builds faster: 128 for each triangle, more where triangles are so many that shafts
/// decide less (docs/decisions/012). The number of threads has no say, as in all that may
/// change a bit.
double pairs_that_pay(double triangles) {
    constexpr double many = 1e6;
    return 128 * triangles * std::max(1.0, std::sqrt(triangles / many));
}

/// Paths and discs ask ray by ray, which Embree answers fastest.
Acceleration structure_of(const WorldGeometry& geometry, const RenderSettings& s) {
    if (s.acceleration != Acceleration::automatic) return s.acceleration;
    if (embree_tracing() == nullptr) return Acceleration::bvh;
    const double triangles = static_cast<double>(geometry.triangles().size());
    const bool asks_blocks = s.integrator == Integrator::vpl;
    return asks_blocks && pairs(s) >= pairs_that_pay(triangles) ? Acceleration::bvh
                                                                : Acceleration::embree;
}

}  // namespace

std::string reason_against_tracing(const RenderSettings& settings) {
    if (!settings.devices.numbers.empty())
        return "GPUs were chosen by their numbers (the processor is none of them); leave --devices "
               "out, or use --backend cuda";
    if (settings.acceleration != Acceleration::embree || embree_tracing() != nullptr) return "";
    return "Embree traces no ray of this build (it was configured without it); use --accel bvh, or "
           "build it in with MIR_WITH_EMBREE=ON";
}

HostTracing trace_on_host(const PlacedScene& placed, const RenderSettings& settings) {
    if (const std::string reason = reason_against_tracing(settings); !reason.empty())
        throw Error(ErrorCode::unsupported, reason);
    AnyExecutor threads = placed.threads;
    CancellableExecutor<AnyExecutor> loops(threads, placed.monitor);
    AnyExecutor executor(loops);
    HostTracing tracing = [&]() -> HostTracing {
        const auto stage = placed.clock.measure(&StageSeconds::build);
        switch (structure_of(placed.geometry, settings)) {
            case Acceleration::kd_tree:
                return {"kdtree", trace_by_kd_tree(placed.geometry, executor)};
            case Acceleration::bvh:
                return {"bvh", trace_by_shafts(placed.geometry, executor)};
            case Acceleration::embree:
            case Acceleration::automatic:
                break;
        }
        return {"embree", embree_tracing()->trace(placed.geometry, placed.monitor)};
    }();
    if (placed.monitor != nullptr) placed.monitor->check();
    return tracing;
}

}  // namespace mir
