// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/band_turn.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace mir {

/// Threads of a process that work on bands of an image, one band each. One of them works before its
/// turn at a time; the others wait for theirs, or are done. So slow processes hold up the fast ones
/// only when those have as many bands waiting as they may.
class BandCrew {
 public:
    /// What a thread has to say.
    struct Event {
        std::uint32_t band;
        bool done;  ///< else it waits for its turn
    };
    /// Work on a band, on a thread of its own.
    using Work = std::function<void(std::uint32_t band, BandTurn& turn)>;

    /// `most`: bands at a time. `seam` is that of turns.
    BandCrew(std::size_t most, FilmSeam& seam, Work work)
        : most_(most), seam_(seam), work_(std::move(work)) {}
    BandCrew(const BandCrew&) = delete;
    BandCrew& operator=(const BandCrew&) = delete;
    /// Waits for its threads; those that wait for a turn end at once.
    ~BandCrew() { stop(); }

    /// True where one more band can begin.
    [[nodiscard]] bool is_free() const;
    /// Begins a band.
    /// @throws std::system_error when there is no thread for it.
    void begin(std::uint32_t band);
    /// Lets a band go on that waits for its turn.
    void give_turn(std::uint32_t band);
    /// What happened since the last call. Waits for it, at most so long.
    /// @throws What work threw.
    [[nodiscard]] std::vector<Event> events(std::chrono::microseconds at_most);
    /// Ends all waiting and waits for the threads.
    void stop();

 private:
    class Turn;
    struct Stopped {};
    static constexpr std::uint32_t nobody = UINT32_MAX;

    void run(std::uint32_t band);
    void say(Event event);

    std::size_t most_;
    FilmSeam& seam_;
    Work work_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Event> events_;
    std::exception_ptr error_;
    std::size_t begun_ = 0;         ///< bands that are not done
    std::uint32_t early_ = nobody;  ///< the band that has not come to its turn
    std::uint32_t turn_ = nobody;   ///< the band that may go on
    bool stopped_ = false;
    std::vector<std::jthread> threads_;
};

}  // namespace mir
