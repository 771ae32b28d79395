// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/render_job.hpp"
#include "runtime/traced_scenes.hpp"

namespace mir {

/// What the host traces through, and its name in statistics.
struct HostTracing {
    const char* name;
    TracedScenePtr scene;
};

/// Why this build cannot trace as the settings want, and what to do. A sentence without its end.
/// Empty where it can.
[[nodiscard]] std::string reason_against_tracing(const RenderSettings& settings);

/// Builds what rays of a render on the host are traced through, in its stage.
/// @throws Error(unsupported) for reason_against_tracing(); Error(cancelled).
[[nodiscard]] HostTracing trace_on_host(const PlacedScene& placed, const RenderSettings& settings);

}  // namespace mir
