// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/bootstrap.hpp"
#include "runtime/render_frame.hpp"

namespace mir {

/// Places VPLs with the sampler that the settings name. `bound` is the largest geometry term of the
/// shading to come, m^-2: samplers that look at the image must use the same.
/// @throws Error for options out of range, and what the sampler throws.
[[nodiscard]] SampledVpls sample_vpls(RenderFrame& frame, float bound);

/// RenderFrame::sample_chains() on the frame's executor, by rays of the host. Paths of the
/// bootstrap come from `shared`, unless it is empty.
[[nodiscard]] VplRecords sample_chains_on_host(RenderFrame& frame, const MetropolisOptions& options,
                                               float bound, const SharedDraw& shared = {});

/// RenderFrame::sample_light_paths() on the frame's executor, by rays of the host.
[[nodiscard]] VplRecords sample_light_paths_on_host(RenderFrame& frame,
                                                    const InstantRadiosityOptions& options);

/// RenderFrame::light_path_luminance() on the frame's executor, by rays of the host.
[[nodiscard]] PathLuminance light_path_luminance_on_host(RenderFrame& frame,
                                                         const VplRecords& sampled, float bound);

/// How chains are to run.
[[nodiscard]] MetropolisOptions metropolis_options(const RenderSettings& settings);

}  // namespace mir
