// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cstdint>

namespace mir::detail {

/// The upper 64 of the 128 bits of a product. By halves, since not every compiler has wider types.
MIR_HD constexpr std::uint64_t high_product(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t low = 0xFFFFFFFFu;
    const std::uint64_t first = (a & low) * (b & low);
    const std::uint64_t second = (a >> 32) * (b & low) + (first >> 32);
    const std::uint64_t third = (a & low) * (b >> 32) + (second & low);
    return (a >> 32) * (b >> 32) + (second >> 32) + (third >> 32);
}

}  // namespace mir::detail
