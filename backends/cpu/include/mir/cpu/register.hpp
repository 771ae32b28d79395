// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/renderer.hpp"

namespace mir::cpu {

/// Adds the compiled CPU renderers: "cpu-blocks", the tuned path, and "cpu", the plain loop that
/// is the oracle. RenderSettings::acceleration says what both trace with.
void add_to(Registry& registry);

/// "Embree 3.13.5" or the like, and the vector instructions that loops will use.
std::string description();

}  // namespace mir::cpu
