// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/primary_sample.hpp"
#include "mir/paths/path_techniques.hpp"

namespace mir {

/// What a chain proposes besides large steps.
enum class Mutation {
    primary,       ///< small steps in primary sample space (Kelemen et al. 2002)
    bidirectional  ///< bidirectional mutations of the path itself (Veach 1997)
};

/// How a Markov chain moves from path to path.
struct ChainOptions {
    Mutation mutation = Mutation::primary;  ///< kind of the steps that are not large
    double large_step_probability = 0.5;    ///< in (0, 1]
    std::uint32_t tries = 8;                ///< candidates of each large step, 1..254
};

}  // namespace mir
