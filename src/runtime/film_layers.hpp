// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/image.hpp"
#include "mir/runtime/any_executor.hpp"
#include "mir/runtime/result.hpp"

#include <cstddef>
#include <vector>

namespace mir {

/// Layers of the film of a render. Those of the bounces, if there are any, come next, then what
/// the bound removed, if that is wanted.
enum FilmLayer : std::size_t {
    direct_layer,
    emission_layer,
    coverage_layer,
    indirect_layer,
    first_bounce_layer
};

/// Moves the images of all layers of a film to their places in a result, and adds up its beauty:
/// emission + direct + indirect.
void take_layers(std::vector<Image<Rgb>> layers, bool removed_layer, RenderResult& result,
                 AnyExecutor& executor);

}  // namespace mir
