// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/core/instruction_set.hpp"

#include <cstdint>

namespace mir::detail {

/// visible_in_packet(tree, origin, points, active, mask) by the processor's widest registers. Not
/// inlined: a walk is much longer than a call, and is compiled for each instruction set once
/// instead of once per caller.
template <class Tree, class... Mask>
[[nodiscard, gnu::noinline]] std::uint32_t ask_packet(const Tree& tree, Vec3 origin,
                                                      const PointPacket& points,
                                                      std::uint32_t active, const Mask&... mask) {
    std::uint32_t seen = 0;
    run_with(best_instruction_set(), [&](auto set) {
        seen = visible_in_packet<set.value>(tree, origin, points, active, mask...);
    });
    return seen;
}

}  // namespace mir::detail
