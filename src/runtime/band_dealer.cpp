// SPDX-License-Identifier: MIT
#include "runtime/band_dealer.hpp"

#include <utility>

namespace mir {

std::optional<std::uint32_t> BandDealer::next(std::size_t part) {
    const std::lock_guard lock(mutex_);
    if (error_) return std::nullopt;
    if (!is_dealt_) {
        if (owners_.size() == bands_) return std::nullopt;
        owners_.push_back(part);
        return static_cast<std::uint32_t>(owners_.size() - 1);
    }
    std::uint32_t& band = next_[part];
    while (band < bands_ && owners_[band] != part) ++band;
    if (band == bands_) return std::nullopt;
    return band++;
}

void BandDealer::wait_for(std::uint32_t band) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return done_ >= band || error_; });
    if (error_) throw Stopped{};
}

void BandDealer::finish(std::uint32_t band) {
    {
        const std::lock_guard lock(mutex_);
        done_ = band + 1;
    }
    changed_.notify_all();
}

void BandDealer::fail(std::uint32_t band, std::exception_ptr error) {
    {
        const std::lock_guard lock(mutex_);
        if (!error_ || band < failed_) {
            error_ = std::move(error);
            failed_ = band;
        }
    }
    changed_.notify_all();
}

}  // namespace mir
