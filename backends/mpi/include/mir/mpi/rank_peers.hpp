// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/peers.hpp"

#include <mpi.h>

#include <deque>

namespace mir::mpi {

/// The ranks of a communicator as processes of a PictureTeam. Messages go from one rank to another,
/// over a copy of the communicator, so that they meet no others. Waiting ranks leave their cores to
/// others. MPI stays the caller's: it is neither begun nor ended, and its errors become exceptions.
/// One thread at a time, one that may call MPI.
class RankPeers final : public Peers {
 public:
    /// To be made by all ranks together, after MPI_Init_thread() with MPI_THREAD_FUNNELED or more.
    /// @throws Error(invalid_argument) before MPI has begun, behind its end, or where it allows no
    ///         other threads; Error(device) when the communicator cannot be used.
    explicit RankPeers(MPI_Comm ranks);
    RankPeers(const RankPeers&) = delete;
    RankPeers& operator=(const RankPeers&) = delete;
    /// To be destroyed by all ranks, before MPI_Finalize().
    ~RankPeers() override;

    [[nodiscard]] std::uint32_t rank() const override { return rank_; }
    [[nodiscard]] std::uint32_t count() const override { return count_; }
    /// Takes in what comes while it waits, so that ranks may send to each other at the same time.
    void send(std::uint32_t to, const Bytes& message) override;
    [[nodiscard]] std::optional<Letter> receive() override;

 private:
    [[nodiscard]] std::optional<Letter> next_letter();

    MPI_Comm ranks_ = MPI_COMM_NULL;
    std::uint32_t rank_ = 0;
    std::uint32_t count_ = 1;
    std::deque<Letter> came_meanwhile_;  ///< while this one sent
};

}  // namespace mir::mpi
