// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace mirconvergence {

/// Pictures of one size in rows of a square grid, from left to right and top to bottom, on `gap`
/// pixels of `ground` between them.
/// @throws mir::Error(invalid_argument) without pictures or for different sizes.
inline mir::Image<mir::Rgb> montage(const std::vector<mir::Image<mir::Rgb>>& pictures,
                                    std::uint32_t gap, mir::Rgb ground) {
    mir::expects(!pictures.empty(),
                 "a montage of no pictures was asked for (it would be empty); give at least one");
    const mir::Extent size = pictures.front().extent();
    const auto count = static_cast<std::uint32_t>(pictures.size());
    const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(pictures.size())));
    const std::uint32_t rows = (count + columns - 1) / columns;
    mir::Image<mir::Rgb> sheet(
        {columns * (size.width + gap) - gap, rows * (size.height + gap) - gap}, ground);
    for (std::uint32_t i = 0; i < count; ++i) {
        mir::expects(pictures[i].extent() == size,
                     "the pictures of a montage differ in size; render them alike");
        const std::uint32_t left = i % columns * (size.width + gap);
        const std::uint32_t top = i / columns * (size.height + gap);
        for (std::uint32_t y = 0; y < size.height; ++y)
            for (std::uint32_t x = 0; x < size.width; ++x)
                sheet(left + x, top + y) = pictures[i](x, y);
    }
    return sheet;
}

}  // namespace mirconvergence
