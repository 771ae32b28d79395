// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/bootstrap_options.hpp"
#include "mir/paths/path_techniques.hpp"

#include <cstdint>

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

/// When the chains end.
enum class ChainStop {
    fixed,  ///< after a fixed number of recorded states: unbiased up to the normalisation
    paper   ///< algorithm 2 as printed, after a number of new geometric VPLs: biased, O(1/N)
};

/// How chains run, whatever they are run for.
struct MetropolisTuning {
    std::uint32_t chains = 1u << 22;    ///< at most, 1..2^22; see BootstrapOptions::starts_at()
    std::uint32_t stride = 64;          ///< mutations from one recorded state to the next
    std::uint32_t suffix_refresh = 8;   ///< further light paths behind each recorded VPL, 0..255
    ChainStop stop = ChainStop::fixed;  ///< when chains end
    ChainOptions chain;                 ///< how they move
    BootstrapOptions bootstrap;         ///< how many paths estimate P_c and seed them
    PathTechniques techniques = PathTechniques::bidirectional;  ///< how paths are built

    /// Checks every value; defined in mir/metropolis/metropolis_options.hpp.
    /// @throws Error(invalid_argument) that names the first bad value.
    inline void validate() const;
};

}  // namespace mir
