// SPDX-License-Identifier: MIT
#pragma once

#include "kernel_choice.hpp"
#include "paper_scene.hpp"

#include <optional>
#include <vector>

namespace mirpaper {

/// Luxels as kernels read them, in some order: planes of words, `count` luxels each.
struct LuxelWords {
    std::uint32_t count = 0;                   ///< padding included
    std::optional<mir::BlockedLayout> layout;  ///< of luxels in squares
    std::vector<std::uint32_t> hits;
    std::vector<std::uint32_t> surfaces;
};

/// The luxels of a scene in the given order, padding last.
LuxelWords luxels_in(LuxelOrder order, const GBuffer& whole, Executor& executor);

}  // namespace mirpaper
