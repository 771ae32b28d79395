// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"
#include "mir/core/space.hpp"
#include "mir/data/tile.hpp"

#include <cstddef>

namespace mir {

/// Which luxels of one tile face and see which VPL, in words. A word holds 32 neighbouring luxels
/// for each VPL: word (i / 32) vpls + j. Neighbouring threads that work on one VPL each, and all
/// threads that work on 32 neighbouring luxels, read neighbouring words or the same one. A view.
template <Space S>
struct VisibilityWords {
    static constexpr Space space = S;           ///< of the memory of the words
    static constexpr std::uint32_t width = 32;  ///< luxels of a word

    const std::uint32_t* words = nullptr;  ///< count() of them
    std::uint32_t vpls = 0;                ///< number of VPLs

    /// True when luxel `i` (blocked index) faces and sees VPL `j`.
    [[nodiscard]] MIR_HD bool sees(LuxelIndex i, VplIndex j) const {
        return (words[std::size_t{i / width} * vpls + j] >> (i % width) & 1u) != 0;
    }

    /// Words of a tile of `luxels` luxels, padding included.
    static constexpr std::size_t count(std::uint32_t luxels, std::uint32_t vpls) {
        return std::size_t{luxels / width} * vpls;
    }
};

}  // namespace mir
