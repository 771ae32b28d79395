// SPDX-License-Identifier: MIT
#pragma once

#include "convergence.hpp"
#include "mir/runtime/renderer.hpp"
#include "options.hpp"
#include "pass_goal_of.hpp"
#include "render_output.hpp"

namespace mirtool {

/// Renders passes until their goal is reached or `monitor` is cancelled. In between writes the
/// picture of those done from time to time. An interrupted picture is not complete. `convergence`
/// sees the passes, unless there is one alone.
/// @throws mir::Error as Renderer::render(); Error(cancelled) before the first pass is done.
mir::RenderResult render_passes(const mir::Renderer& renderer, const mir::Scene& scene,
                                const RenderOptions& options, const OutputPaths& paths,
                                mir::Monitor& monitor, Convergence& convergence);

}  // namespace mirtool
