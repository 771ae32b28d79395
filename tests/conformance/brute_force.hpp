// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/referee.hpp"
#include "mir/validation/brute_force.hpp"

namespace mirtest {

using mir::validation::BruteForceRayCaster;
using mir::validation::BruteForceScene;
using mir::validation::BruteForceVisibility;

}  // namespace mirtest
