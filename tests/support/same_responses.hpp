// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/image_response.hpp"

#include <bit>
#include <cstdint>
#include <vector>

namespace mirtest {

/// Whether there are any, and all of them have the same bits.
inline bool same_bits(const std::vector<mir::ImageResponse>& a,
                      const std::vector<mir::ImageResponse>& b) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    bool same = a.size() == b.size() && !a.empty();
    for (std::size_t j = 0; same && j < a.size(); ++j)
        same = bits(a[j].r) == bits(b[j].r) && bits(a[j].g) == bits(b[j].g) &&
               bits(a[j].b) == bits(b[j].b) && a[j].lit_luxels == b[j].lit_luxels;
    return same;
}

}  // namespace mirtest
