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
/// the film. A pure function of cell and members. Host and device: see CameraOptics.
struct ProbeRays {
    CameraOptics optics;       ///< of the camera that looks at the image
    float aspect = 1.0f;       ///< width / height of the film
    std::uint32_t luxels = 1;  ///< wanted; cells() has at least as many
    std::uint64_t seed = 0;    ///< of the places on film and lens

    /// At least `wanted` rays of a film of this width / height.
    ProbeRays(const Camera& camera, float film_aspect, std::uint32_t wanted = 256,
              std::uint64_t seed_of_places = 0)
        : optics(camera.optics()), aspect(film_aspect), luxels(wanted), seed(seed_of_places) {
        const double width =
            std::ceil(std::sqrt(static_cast<double>(luxels) * static_cast<double>(aspect)));
        // Not a number where the aspect is none: ImageProbe refuses that.
        if (width >= 1.0) grid_.width = static_cast<std::uint32_t>(std::min(width, 65536.0));
        grid_.height = std::max((luxels + grid_.width - 1) / grid_.width, 1u);
    }

    /// The grid, of nearly square cells.
    [[nodiscard]] MIR_HD Extent cells() const { return grid_; }

    /// Ray of one cell.
    [[nodiscard]] MIR_HD Ray operator()(std::uint32_t x, std::uint32_t y) const {
        Random random(seed, Stream::probe, std::uint64_t{y} * grid_.width + x);
        const Vec2 cell(static_cast<float>(x), static_cast<float>(y));
        const Vec2 size(static_cast<float>(grid_.width), static_cast<float>(grid_.height));
        const Vec2 film = (cell + random.next_2d()) / size;
        return optics.ray(film, aspect, random.next_2d());
    }

 private:
    Extent grid_{1, 1};
};

}  // namespace mir
