// SPDX-License-Identifier: MIT
#pragma once

#include "mir/validation/referee.hpp"

namespace mirtest {

using Double3 = mir::detail::Double3;
using mir::validation::LineHit;
using mir::validation::Referee;

}  // namespace mirtest
