// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/metropolis/metropolis_tuning.hpp"
#include "mir/metropolis/primary_sample.hpp"

#include <algorithm>
#include <limits>

namespace mir {

/// Most states recorded for each new VPL that ChainStop::paper waits for. Without it, a path that
/// nothing moves would hold it for ever.
inline constexpr std::uint64_t paper_stop_cap = 64;

/// How many states a MetropolisSampler records, how far paths go, and how chains run.
struct MetropolisOptions : MetropolisTuning {
    std::uint32_t states = 256;    ///< n: states recorded by all chains together
    bool emitter_vpls = false;     ///< also direct light by VPLs: paths of two edges
    std::uint8_t max_bounce = 32;  ///< largest number of scattering events, 1..63
    std::uint64_t seed = 0;        ///< of every random number of the run

    /// Fewest edges of a path, camera's and lamp's included: 2 for direct light, else 3.
    [[nodiscard]] std::uint32_t min_edges() const { return emitter_vpls ? 2 : 3; }
    /// Most edges of a path: one more than it scatters.
    [[nodiscard]] std::uint32_t max_edges() const { return std::uint32_t{max_bounce} + 1; }
    /// @throws Error(invalid_argument) that names the first bad value. Error(limit_exceeded) when
    /// more states are wanted than `limits` allows VPLs.
    void check(const Limits& limits) const;
};

inline void MetropolisTuning::validate() const {
    expects(chains > 0 && chains <= max_chains,
            "the number of Markov chains must be 1 to 4194304; as many as VPLs are usual");
    expects(stride > 0 && stride <= 1u << 20,
            "the stride between recorded states must be 1 to 1048576; 64 is usual");
    expects(suffix_refresh < 256, "suffix refreshes must be 0 to 255; 8 is usual");
    expects(chain.tries > 0 && chain.tries < max_tries,
            "the tries of a large step must be 1 to 254; 8 is usual");
    expects(chain.large_step_probability > 0.0 && chain.large_step_probability <= 1.0,
            "the probability of a large step must be above 0 (a chain might never leave a part of "
            "the scene) and at most 1; 0.5 is usual");
    expects(
        bootstrap.relative_error >= 0.0,
        "the relative error asked of P_c must be positive, or 0 for one by the number of chains");
    expects(bootstrap.min_paths > 0 && bootstrap.min_paths <= bootstrap.max_paths,
            "the bootstrap must draw at least one path and may not draw more at least than at "
            "most; 16384 to 4194304 is usual");
}

inline void MetropolisOptions::check(const Limits& limits) const {
    expects(states > 0,
            "0 recorded states were asked for (there would be no light); ask for at least 1, 256 "
            "is usual");
    check_limit(states, limits.vpls, "vpls");
    validate();
    const std::uint64_t cap = stop == ChainStop::paper ? paper_stop_cap : 1;
    const std::uint32_t fewest =
        bootstrap.starts_at(std::numeric_limits<double>::infinity(), std::min(chains, states));
    expects((states / fewest + 1) * cap * stride <= ~std::uint32_t{0},
            "a chain might make more than 2^32 mutations (a step is named by 32 bits); ask for a "
            "shorter stride, fewer VPLs or, below 256, more chains");
}

}  // namespace mir
