// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/pair_search.hpp"

#include <array>
#include <atomic>
#include <cstddef>

namespace mir {

/// How often each PairState came up, by its number; counted from any thread.
struct PairTally {
    using Counts = std::array<std::atomic<std::uint64_t>, 4>;

    Counts blocks{};
    Counts clusters{};

    [[nodiscard]] std::uint64_t block(PairState s) const {
        return blocks[static_cast<std::size_t>(s)];
    }
    [[nodiscard]] std::uint64_t cluster(PairState s) const {
        return clusters[static_cast<std::size_t>(s)];
    }
};

/// The watch of a ShaftPass on the host that counts. The tally must outlive it.
struct TallyPairs {
    PairTally* tally = nullptr;

    void block(PairState s) const { ++tally->blocks[static_cast<std::size_t>(s)]; }
    void cluster(PairState s) const { ++tally->clusters[static_cast<std::size_t>(s)]; }
};

}  // namespace mir
