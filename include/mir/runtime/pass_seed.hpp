// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"

namespace mir {

/// Seed of pass `pass` of a progressive render. That of the render for the first, else 64 bits of a
/// Philox block of its own, so that no random number of one pass is used in another. A pure
/// function of both; two passes share a seed with probability 2^-64.
MIR_HD constexpr std::uint64_t pass_seed(std::uint64_t seed, std::uint64_t pass) {
    if (pass == 0) return seed;
    const Bits128 bits = Random(seed, Stream::pass, pass).block(0);
    return std::uint64_t{bits.word[0]} << 32 | bits.word[1];
}

}  // namespace mir
