// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/renderer.hpp"

namespace mir::cpu {

/// Adds the compiled CPU renderers: "cpu-blocks", the tuned path (default), "cpu", the plain loop
/// that is the oracle, and "os", "rc" and "rcvp", the paper's. They trace with what
/// RenderSettings::acceleration says.
void add_to(Registry& registry);

/// "Embree 3.13.5" or the like, and the vector instructions that loops will use.
std::string description();

}  // namespace mir::cpu
