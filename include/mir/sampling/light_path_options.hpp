// SPDX-License-Identifier: MIT
#pragma once

namespace mir {

/// When a light path ends.
enum class Termination {
    roulette,  ///< by chance, with the albedo as odds of survival: unbiased
    levels     ///< Keller's: floor(rho^n N) particles survive n bounces; consistent
};

/// Where the numbers of a light path come from.
enum class Sequence {
    random,  ///< independent Philox numbers
    halton   ///< Halton sequence over paths, shifted by the seed; random past its dimensions
};

}  // namespace mir
