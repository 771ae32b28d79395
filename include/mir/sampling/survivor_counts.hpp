// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace mir {

/// SurvivorCounts as kernels read them. A view; thread-safe.
struct SurvivorCountsView {
    const std::uint64_t* counts = nullptr;  ///< by level
    std::uint32_t size = 0;                 ///< levels

    /// Particles of level `n`; 0 beyond the last.
    [[nodiscard]] MIR_HD std::uint64_t at(std::size_t n) const { return n < size ? counts[n] : 0; }
    /// Share of level n - 1 that takes part in level `n` >= 1.
    [[nodiscard]] MIR_HD float survival(std::size_t n) const {
        return static_cast<float>(static_cast<double>(at(n)) / static_cast<double>(at(n - 1)));
    }
};

/// How many particles take part in each level of Keller's instant radiosity. Particle i takes part
/// in level n when i < at(n); survivors carry the actual ratio of the counts, so that flooring
/// loses no energy at the levels that exist.
class SurvivorCounts {
 public:
    SurvivorCounts() = default;

    /// `particles` start. With `from_lamp` (Keller) level n holds floor(rho^n N) of them, the lamp
    /// being level 0; without (section 3 of the 2009 paper) level n >= 1 holds floor(rho^(n-1) N).
    SurvivorCounts(std::uint64_t particles, double rho, std::uint8_t max_level, bool from_lamp) {
        counts_.push_back(particles);
        double share = from_lamp ? rho : 1.0;
        for (std::uint8_t n = 1; n <= max_level; ++n, share *= rho) {
            const auto count = static_cast<std::uint64_t>(share * static_cast<double>(particles));
            if (count == 0) break;
            counts_.push_back(count);
        }
    }

    /// The largest set whose levels hold at most `vpls` VPLs together. There is one particle at
    /// least.
    static SurvivorCounts for_total(std::uint64_t vpls, double rho, std::uint8_t max_level,
                                    bool from_lamp) {
        std::uint64_t low = 1;
        std::uint64_t high = std::max<std::uint64_t>(vpls, 1);
        while (low < high) {
            const std::uint64_t middle = low + (high - low + 1) / 2;
            const SurvivorCounts trial(middle, rho, max_level, from_lamp);
            if (trial.vpls(from_lamp) <= vpls)
                low = middle;
            else
                high = middle - 1;
        }
        return {low, rho, max_level, from_lamp};
    }

    /// Particles of level `n`; 0 beyond the last.
    [[nodiscard]] std::uint64_t at(std::size_t n) const { return view().at(n); }

    /// Share of level n - 1 that takes part in level `n` >= 1.
    [[nodiscard]] float survival(std::size_t n) const { return view().survival(n); }

    /// By level.
    [[nodiscard]] std::span<const std::uint64_t> counts() const { return counts_; }
    /// What the host reads; valid until this changes or ends.
    [[nodiscard]] SurvivorCountsView view() const {
        return {counts_.data(), static_cast<std::uint32_t>(counts_.size())};
    }

    /// VPLs of all levels; the lamp's count only with `from_lamp`.
    [[nodiscard]] std::uint64_t vpls(bool from_lamp) const {
        std::uint64_t sum = 0;
        for (std::size_t n = from_lamp ? 0 : 1; n < counts_.size(); ++n) sum += counts_[n];
        return sum;
    }

 private:
    std::vector<std::uint64_t> counts_;
};

}  // namespace mir
