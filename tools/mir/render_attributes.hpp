// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/exr.hpp"
#include "mir/runtime/result.hpp"
#include "options.hpp"

#include <vector>

namespace mirtool {

/// The layers that were asked for, the picture first; they refer to `result`.
std::vector<mir::ExrLayer> layers_of(const mir::RenderResult& result, const RenderOptions& options);

/// What a file says of how its picture was made.
mir::ExrAttributes attributes_of(const mir::RenderResult& result, const RenderOptions& options);

}  // namespace mirtool
