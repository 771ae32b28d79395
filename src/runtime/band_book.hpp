// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace mir {

/// Which process has which band of a loop, and whose turn it is. Bands are dealt to whoever asks,
/// from top to bottom; turns come in the order of the bands.
class BandBook {
 public:
    /// For a loop over so many bands. `owners` says who had which band in the last loop, and is
    /// kept for the next. Over as many bands the same processes get the same ones. So many bands
    /// are `done` before.
    BandBook(std::uint32_t bands, std::vector<std::uint32_t>& owners, std::uint32_t done = 0)
        : owners_(owners),
          ready_(bands, false),
          is_dealt_(done == 0 && owners.size() == bands),
          done_(done) {
        if (!is_dealt_) owners_.assign(done, 0);
        if (is_dealt_) dealt_.resize(bands, false);
    }

    /// The next band of a process; none when it gets no more.
    [[nodiscard]] std::optional<std::uint32_t> deal(std::uint32_t rank) {
        if (!is_dealt_) {
            if (owners_.size() == ready_.size()) return std::nullopt;
            owners_.push_back(rank);
            return static_cast<std::uint32_t>(owners_.size() - 1);
        }
        for (std::uint32_t band = 0; band < dealt_.size(); ++band) {
            if (dealt_[band] || owners_[band] != rank) continue;
            dealt_[band] = true;
            return band;
        }
        return std::nullopt;
    }

    /// The process of a band waits for its turn.
    void ready(std::uint32_t band) { ready_.at(band) = true; }
    /// The band whose turn it is was done.
    void done() { ++done_; }

    /// The band whose turn has come and who waits for it, once.
    [[nodiscard]] std::optional<std::uint32_t> turn() {
        if (is_complete() || !ready_[done_]) return std::nullopt;
        ready_[done_] = false;
        return done_;
    }
    /// Who has a dealt band.
    [[nodiscard]] std::uint32_t owner(std::uint32_t band) const { return owners_.at(band); }
    /// All bands are done.
    [[nodiscard]] bool is_complete() const { return done_ == ready_.size(); }

 private:
    std::vector<std::uint32_t>& owners_;
    std::vector<bool> ready_;
    std::vector<bool> dealt_;  ///< where the owners are known
    bool is_dealt_;
    std::uint32_t done_;  ///< bands, from the top
};

}  // namespace mir
