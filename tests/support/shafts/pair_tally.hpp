// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/exact/pair_search.hpp"

#include <array>
#include <atomic>
#include <cstddef>

namespace mir {

/// How often each PairState came up, by its number; counted from any thread.
struct PairTally {
    /// Pairs by the number of their PairState.
    using Counts = std::array<std::atomic<std::uint64_t>, 4>;

    Counts blocks{};    ///< pairs of 256 luxels and a VPL
    Counts clusters{};  ///< pairs of 32 luxels and a VPL

    /// Pairs of 256 luxels and a VPL that came to this state.
    [[nodiscard]] std::uint64_t block(PairState s) const {
        return blocks[static_cast<std::size_t>(s)];
    }
    /// Pairs of 32 luxels and a VPL that came to this state.
    [[nodiscard]] std::uint64_t cluster(PairState s) const {
        return clusters[static_cast<std::size_t>(s)];
    }
};

/// The watch of a ShaftPass on the host that counts. The tally must outlive it.
struct TallyPairs {
    PairTally* tally = nullptr;  ///< not null

    /// Counts a pair of 256 luxels and a VPL.
    void block(PairState s) const { ++tally->blocks[static_cast<std::size_t>(s)]; }
    /// Counts a pair of 32 luxels and a VPL.
    void cluster(PairState s) const { ++tally->clusters[static_cast<std::size_t>(s)]; }
};

}  // namespace mir
