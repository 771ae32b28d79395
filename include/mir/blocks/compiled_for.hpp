// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/shading.hpp"
#include "mir/core/instruction_set.hpp"
#include "mir/shading/vpl_shading.hpp"

namespace mir::blocks {

/// The fastest shading with the bits of `shade` in loops compiled for `Set`.
template <InstructionSet Set, Shading F>
[[nodiscard]] F compiled_for(const F& shade) {
    return shade;
}
template <InstructionSet Set, Bsdf B>
[[nodiscard]] VplShading<B, FusedRoundingFor<Set>> compiled_for(const VplShading<B>& shade) {
    return {shade.bound};
}

}  // namespace mir::blocks
