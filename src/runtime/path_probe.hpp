// SPDX-License-Identifier: MIT
#pragma once

#include "mir/sampling/probe_rays.hpp"
#include "runtime/render_job.hpp"

namespace mir {

/// Luxels of a render that tell what its VPLs give to the image.
[[nodiscard]] inline ProbeRays path_probe(const RenderJob& job) {
    return {job.rays.camera, job.aspect(), 256, job.settings.seed};
}

}  // namespace mir
