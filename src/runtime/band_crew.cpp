// SPDX-License-Identifier: MIT
#include "runtime/band_crew.hpp"

#include <utility>

namespace mir {

/// Of one band.
class BandCrew::Turn final : public BandTurn {
 public:
    Turn(BandCrew& crew, std::uint32_t band) : crew_(crew), band_(band) {}

    void wait() override {
        if (has_come_) return;
        crew_.say({band_, false});
        std::unique_lock lock(crew_.mutex_);
        crew_.changed_.wait(lock, [&] { return crew_.turn_ == band_ || crew_.stopped_; });
        if (crew_.turn_ != band_) throw Stopped{};
        has_come_ = true;
    }
    [[nodiscard]] FilmSeam* seam() override { return &crew_.seam_; }

 private:
    BandCrew& crew_;
    std::uint32_t band_;
    bool has_come_ = false;
};

bool BandCrew::is_free() const {
    const std::lock_guard lock(mutex_);
    return early_ == nobody && begun_ < most_ && !error_;
}

void BandCrew::begin(std::uint32_t band) {
    {
        const std::lock_guard lock(mutex_);
        ++begun_;
        early_ = band;
    }
    threads_.emplace_back([this, band] { run(band); });
}

void BandCrew::give_turn(std::uint32_t band) {
    {
        const std::lock_guard lock(mutex_);
        turn_ = band;
    }
    changed_.notify_all();
}

std::vector<BandCrew::Event> BandCrew::events(std::chrono::microseconds at_most) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, at_most, [&] { return !events_.empty() || error_; });
    if (error_) std::rethrow_exception(error_);
    return std::exchange(events_, {});
}

void BandCrew::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
    }
    changed_.notify_all();
    threads_.clear();
}

void BandCrew::run(std::uint32_t band) {
    try {
        Turn turn(*this, band);
        work_(band, turn);
        turn.wait();
        say({band, true});
    } catch (const Stopped&) {
    } catch (...) {
        {
            const std::lock_guard lock(mutex_);
            if (!error_) error_ = std::current_exception();
        }
        changed_.notify_all();
    }
}

void BandCrew::say(Event event) {
    {
        const std::lock_guard lock(mutex_);
        events_.push_back(event);
        if (event.done) --begun_;
        if (!event.done) early_ = nobody;
    }
    changed_.notify_all();
}

}  // namespace mir
