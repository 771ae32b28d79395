// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>

namespace mirpy {

/// Declares what several processes render by.
void bind_team(nanobind::module_& m);

}  // namespace mirpy
