// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/image.hpp"
#include "mir/runtime/any_executor.hpp"
#include "mir/runtime/film_layer.hpp"
#include "mir/runtime/result.hpp"

#include <vector>

namespace mir {

/// Moves a film's layers to their places in a result and makes its beauty. Beauty is emission +
/// direct + indirect.
void take_layers(std::vector<Image<Rgb>> layers, bool removed_layer, RenderResult& result,
                 AnyExecutor& executor);

}  // namespace mir
