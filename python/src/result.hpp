// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/result.hpp"
#include "options.hpp"

#include <nanobind/nanobind.h>

namespace mirpy {

/// A finished picture as Python holds it.
struct PyResult {
    mir::RenderResult result;
    mirtool::RenderOptions options;  ///< that it was made with
};

/// Declares the class Result.
void bind_result(nanobind::module_& m);

}  // namespace mirpy
