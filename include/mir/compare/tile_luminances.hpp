// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <algorithm>
#include <vector>

namespace mir {

/// Mean luminance of an image in square tiles. In W m^-2 sr^-1 where the image is radiance.
struct TileLuminances {
    std::uint32_t side = 1;    ///< of a tile, pixels; those at the right and below may be smaller
    Extent tiles;              ///< across and down
    std::vector<double> mean;  ///< row by row, each over the pixels of its own tile
};

/// At most `most` >= 1 tiles in each direction. Sides have 8 pixels or more.
inline TileLuminances tile_luminances(const Image<Rgb>& image, std::uint32_t most) {
    const auto parts = [](std::uint32_t whole, std::uint32_t part) {
        return (whole + part - 1) / part;
    };
    TileLuminances t;
    t.side = std::max(8u, parts(std::max(image.width(), image.height()), most));
    t.tiles = {parts(image.width(), t.side), parts(image.height(), t.side)};
    t.mean.resize(static_cast<std::size_t>(t.tiles.area()));
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x)
            t.mean[std::size_t{y / t.side} * t.tiles.width + x / t.side] +=
                static_cast<double>(luminance(image(x, y)));
    for (std::uint32_t i = 0; i < t.mean.size(); ++i) {
        const std::uint32_t x = i % t.tiles.width * t.side;
        const std::uint32_t y = i / t.tiles.width * t.side;
        const std::uint64_t pixels = std::uint64_t{std::min(t.side, image.width() - x)} *
                                     std::min(t.side, image.height() - y);
        t.mean[i] /= static_cast<double>(pixels);
    }
    return t;
}

}  // namespace mir
