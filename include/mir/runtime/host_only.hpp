// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/settings.hpp"

#include <string>

namespace mir {

/// Why no GPU renders these settings, and what to do about it: a sentence without its end. Empty
/// where one can.
[[nodiscard]] inline std::string host_only(const RenderSettings& s) {
    if (s.acceleration == Acceleration::embree)
        return "Embree traces on the processor only (this backend traces on a GPU); use --accel "
               "bvh, or --backend cpu";
    if (s.integrator != Integrator::vpl) return "";
    if (s.compensate > 0)
        return "what the bound removed is traced back on the processor only (this backend keeps "
               "its luxels to itself); use --backend cpu or leave --compensate out";
    if (s.vsl.enabled)
        return "spheres light luxels on the processor only (this backend keeps its luxels to "
               "itself); use --backend cpu or leave --vsl out";
    if (s.glossy.enabled)
        return "VPLs keep the lobes of their surfaces on the processor only (kernels of this "
               "backend read none); use --backend cpu or leave --glossy out";
    return "";
}

}  // namespace mir
