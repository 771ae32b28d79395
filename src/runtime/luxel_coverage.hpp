// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"
#include "mir/for_each_luxel.hpp"

namespace mir {

/// White where the luxels of a G-buffer see a surface, black elsewhere. A Film makes the alpha of
/// pixels from it.
template <TiledGBuffer G, Executor E>
[[nodiscard]] Image<Rgb> luxel_coverage(const G& gbuffer, E& executor) {
    auto image = Image<Rgb>::unwritten(gbuffer.extent());
    for_each_luxel(gbuffer, executor,
                   [&](std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
                       image(x, y) = is_empty(luxels.hit(i)) ? Rgb{} : Rgb{1, 1, 1};
                   });
    return image;
}

}  // namespace mir
