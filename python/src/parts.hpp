// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>

namespace mirpy {

/// Declares the stages that work on arrays: visibility(), reconstruct() and reshade().
void bind_parts(nanobind::module_& m);
/// Declares gbuffer().
void bind_gbuffer(nanobind::module_& m);
/// Declares the comparison of pictures.
void bind_compare(nanobind::module_& m);

}  // namespace mirpy
