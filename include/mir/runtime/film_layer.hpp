// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

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

}  // namespace mir
