// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <vector>

namespace mir {

/// Deals the bands of an image to the parts of a frame. They work at the same time; what they do at
/// a band's end happens in the order of the bands. Thread-safe.
class BandDealer {
 public:
    /// What wait_for() throws when work on another band failed.
    struct Stopped {};

    /// For a loop over so many bands. `owners` says which part has which band, and is to be empty
    /// where nobody has any: whoever is free then gets the next. It must outlive the loop.
    BandDealer(std::uint32_t bands, std::size_t parts, std::vector<std::size_t>& owners)
        : bands_(bands), owners_(owners), is_dealt_(!owners.empty()), next_(parts, 0) {}

    /// The next band of a part; none at the end and when work failed.
    [[nodiscard]] std::optional<std::uint32_t> next(std::size_t part);
    /// Returns when the bands above are that far.
    /// @throws Stopped
    void wait_for(std::uint32_t band);
    /// Work on a band, for which its part has waited, is so far that the next band may follow.
    void finish(std::uint32_t band);
    /// Work on a band has failed: nobody waits or begins any more.
    void fail(std::uint32_t band, std::exception_ptr error);
    /// Throws the error of the uppermost band that failed, if any.
    void rethrow() const {
        if (error_) std::rethrow_exception(error_);
    }

 private:
    std::uint32_t bands_;
    std::vector<std::size_t>& owners_;
    bool is_dealt_;
    std::vector<std::uint32_t> next_;  ///< of each part, where all bands are dealt: not above it
    std::mutex mutex_;
    std::condition_variable changed_;
    std::uint32_t done_ = 0;  ///< bands, from the top
    std::uint32_t failed_ = 0;
    std::exception_ptr error_;
};

}  // namespace mir
