// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/data/tile.hpp"
#include "mir/scene/camera.hpp"

#include <algorithm>
#include <cmath>

namespace mir {

/// Camera rays of a few luxels that are spread over a whole image. One at a random place of each
/// cell of a grid on the film, so that the mean over them is an unbiased estimate of the mean over
/// the film. A pure function of cell and members.
struct ProbeRays {
    Camera camera;               ///< that looks at the image
    float aspect = 1.0f;         ///< width / height of the film
    std::uint32_t luxels = 256;  ///< wanted; cells() has at least as many
    std::uint64_t seed = 0;      ///< of the places on film and lens

    /// The grid: nearly square cells.
    [[nodiscard]] Extent cells() const {
        const double width =
            std::ceil(std::sqrt(static_cast<double>(luxels) * static_cast<double>(aspect)));
        const auto columns = static_cast<std::uint32_t>(std::clamp(width, 1.0, 65536.0));
        return {columns, std::max((luxels + columns - 1) / columns, 1u)};
    }

    /// Ray of one cell.
    [[nodiscard]] Ray operator()(std::uint32_t x, std::uint32_t y) const {
        const Extent grid = cells();
        Random random(seed, Stream::probe, std::uint64_t{y} * grid.width + x);
        const Vec2 cell(static_cast<float>(x), static_cast<float>(y));
        const Vec2 size(static_cast<float>(grid.width), static_cast<float>(grid.height));
        const Vec2 film = (cell + random.next_2d()) / size;
        return camera.ray(film, aspect, random.next_2d());
    }
};

}  // namespace mir
