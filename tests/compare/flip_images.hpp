// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <cstdint>

// Procedural images of 96 x 64 pixels, so that what another program computes for them can be
// tabulated: every value is a short formula of x, y and the channel c, rounded to float.
namespace mirtest {

inline constexpr mir::Extent flip_size{96, 64};

/// The image with f(x, y, c) in channel c.
template <class F>
mir::Image<mir::Rgb> painted(const F& f) {
    mir::Image<mir::Rgb> image(flip_size);
    for (std::uint32_t y = 0; y < flip_size.height; ++y)
        for (std::uint32_t x = 0; x < flip_size.width; ++x)
            image(x, y) = {static_cast<float>(f(x, y, 0u)), static_cast<float>(f(x, y, 1u)),
                           static_cast<float>(f(x, y, 2u))};
    return image;
}

/// Ramps: red across, green down, blue diagonal and repeated.
inline double ramp(std::uint32_t x, std::uint32_t y, std::uint32_t c) {
    if (c == 0) return x / 95.0;
    return c == 1 ? y / 63.0 : (x + y) % 32 / 31.0;
}

/// Numbers in [0, 1] without visible order.
inline double noise(std::uint32_t x, std::uint32_t y, std::uint32_t c) {
    return (x * 73 + y * 151 + c * 199 + x * y * 37) % 256 / 255.0;
}

/// True inside of a disc around (60, 20).
inline bool in_spot(std::uint32_t x, std::uint32_t y) {
    const auto square = [](std::int64_t d) { return d * d; };
    return square(std::int64_t{x} - 60) + square(std::int64_t{y} - 20) < 64;
}

/// Scene-referred: a dim room with a lamp, contrast about 1500 to 1.
inline double room(std::uint32_t x, std::uint32_t y, std::uint32_t c) {
    return 0.05 * ramp(x, y, c) + (in_spot(x, y) ? 40.0 : 0.0);
}

}  // namespace mirtest
