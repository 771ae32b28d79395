// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"

namespace mirtool {

/// Names options of chains that were given and changed nothing, because no chain mutated.
void note_idle_options(const mir::RenderSettings& settings, mir::RenderResult& result);

}  // namespace mirtool
