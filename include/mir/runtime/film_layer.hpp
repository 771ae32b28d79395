// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/settings.hpp"

#include <cstddef>

namespace mir {

/// Layers of the film of a render. Those of the bounces, if there are any, come next, then what
/// the bound removed or the variance of the picks, if that is wanted.
enum FilmLayer : std::size_t {
    direct_layer,
    emission_layer,
    coverage_layer,
    indirect_layer,
    first_bounce_layer
};

/// Layers behind those of the bounces. At most one: cuts do not tell what the bound removed.
[[nodiscard]] inline std::size_t extra_layers(const RenderSettings& settings) {
    return settings.removed_layer || settings.pick_error_layer ? 1 : 0;
}

}  // namespace mir
