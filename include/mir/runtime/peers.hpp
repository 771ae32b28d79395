// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mir {

/// Messages among processes that make pictures together. Process 0 leads: the others send to it,
/// and it to them. Messages from one to another arrive in the order in which they were sent. One
/// thread at a time. To be derived from where processes have a way to talk (mir::mpi has).
class Peers {
 public:
    using Bytes = std::vector<std::byte>;  ///< what a message holds

    /// A message that came.
    struct Letter {
        std::uint32_t from = 0;  ///< number of the sender
        Bytes bytes;             ///< as they were sent
    };

    Peers() = default;
    Peers(const Peers&) = delete;
    Peers& operator=(const Peers&) = delete;
    virtual ~Peers() = default;

    /// Number of this process, from 0.
    [[nodiscard]] virtual std::uint32_t rank() const = 0;
    /// Number of all processes.
    [[nodiscard]] virtual std::uint32_t count() const = 0;
    /// Sends a message; may wait until it is received. The other may be sending to this process at
    /// the same time: one that waits must take in meanwhile what comes, for receive().
    /// @throws Error(device) when it cannot be sent.
    virtual void send(std::uint32_t to, const Bytes& message) = 0;
    /// A message that has come, if any has; does not wait.
    /// @throws Error(device) when none can come any more.
    [[nodiscard]] virtual std::optional<Letter> receive() = 0;
};

}  // namespace mir
