// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <array>
#include <bit>
#include <cstdint>

namespace mir::validation::detail {

inline auto bits_of(const Rgb& c) { return std::bit_cast<std::array<std::uint32_t, 3>>(c); }

/// Pixels that differ in at least one bit. Of images of two sizes the largest number.
inline std::size_t pixels_that_differ(const Image<Rgb>& a, const Image<Rgb>& b) {
    if (!(a.extent() == b.extent())) return static_cast<std::size_t>(-1);
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        count += bits_of(a.pixels()[i]) == bits_of(b.pixels()[i]) ? 0 : 1;
    return count;
}

}  // namespace mir::validation::detail
