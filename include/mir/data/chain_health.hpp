// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/path_luminance.hpp"

#include <algorithm>
#include <cstdint>

namespace mir {

/// Proposals of one kind of mutation.
struct MutationCount {
    std::uint64_t proposed = 0;  ///< all of them
    std::uint64_t accepted = 0;  ///< those that the chain moved to

    /// Counts one proposal, accepted or not.
    MIR_HD void add(bool taken) {
        ++proposed;
        accepted += taken ? 1 : 0;
    }
    /// Adds the counts of another chain.
    void add(const MutationCount& other) {
        proposed += other.proposed;
        accepted += other.accepted;
    }
    /// 0..1; 0 when nothing was proposed.
    [[nodiscard]] double rate() const {
        return proposed > 0 ? static_cast<double>(accepted) / static_cast<double>(proposed) : 0.0;
    }
};

/// What the chains of a MetropolisSampler say about themselves.
struct ChainHealth {
    std::uint32_t chains = 0;            ///< whose counts are added here
    std::uint64_t mutations = 0;         ///< of all chains, suffix refreshes not counted
    MutationCount large;                 ///< independent steps (of several tries each)
    MutationCount small;                 ///< Kelemen's small steps
    MutationCount bidirectional;         ///< Veach's mutation
    MutationCount suffix;                ///< refreshes of the light behind a VPL
    std::uint64_t longest_stay = 0;      ///< most mutations rejected in a row
    std::uint64_t recorded_states = 0;   ///< n
    std::uint64_t distinct_vpls = 0;     ///< geometric VPLs among them
    double effective_samples = 0.0;      ///< what n is worth in independent states, at most n:
                                         ///< the least over x, y, z of x_v, log Y(R) and k
    double split_r_hat = 1.0;            ///< the largest over the same numbers; 1 is ideal
    PathLuminance luminance;             ///< P_c from the bootstrap
    PathLuminance large_step_luminance;  ///< P_c again, from the proposals of the large steps
    bool capped = false;                 ///< a chain stopped before its last state

    /// Adds the counts of one more chain.
    void add(const ChainHealth& chain) {
        ++chains;
        mutations += chain.mutations;
        large.add(chain.large);
        small.add(chain.small);
        bidirectional.add(chain.bidirectional);
        suffix.add(chain.suffix);
        longest_stay = std::max(longest_stay, chain.longest_stay);
        recorded_states += chain.recorded_states;
        distinct_vpls += chain.distinct_vpls;
        capped = capped || chain.capped;
    }

    /// Difference of the two estimates of P_c in standard errors. 0 when one has no paths, or both
    /// have no error.
    [[nodiscard]] double luminance_z() const {
        if (luminance.paths == 0 || large_step_luminance.paths == 0) return 0.0;
        const double error =
            std::hypot(luminance.standard_error, large_step_luminance.standard_error);
        return error > 0.0 ? (large_step_luminance.mean - luminance.mean) / error : 0.0;
    }
};

}  // namespace mir
