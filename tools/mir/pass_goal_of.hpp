// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/pass_goal.hpp"
#include "options.hpp"

namespace mirtool {

/// Where passes are to end.
mir::PassGoal goal_of(const PassOptions& options);

/// @throws mir::Error(invalid_argument) for options that contradict each other.
void check(const PassOptions& options);

}  // namespace mirtool
