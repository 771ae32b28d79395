// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/device/leaf_pool.hpp"
#include "mir/shaft/device/work_queue.hpp"

#include <cstdint>
#include <vector>

namespace mirtest {

/// A queue of kernels and its memory.
template <class T>
class Queued {
 public:
    /// Empty, with room for so many items.
    explicit Queued(std::size_t capacity) : items_(capacity) {}
    /// Full of these.
    explicit Queued(std::vector<T> items) : items_(std::move(items)) {
        counters_[0] = static_cast<std::uint32_t>(items_.size());
    }

    /// Valid while this stays where it is.
    [[nodiscard]] mir::WorkQueue<T> view() {
        return {items_.data(), static_cast<std::uint32_t>(items_.size()), counters_, counters_ + 1};
    }
    /// What is in it, taken or not.
    [[nodiscard]] std::vector<T> items() {
        return {items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(view().size())};
    }
    /// Items that were to be added, in it or not.
    [[nodiscard]] std::uint32_t asked() const { return counters_[0]; }
    [[nodiscard]] std::uint32_t taken() const { return counters_[1]; }

 private:
    std::vector<T> items_;
    std::uint32_t counters_[2] = {0, 0};
};

/// A LeafPool and its memory: words of ones, and some behind the last, which nothing may change.
class PoolMemory {
 public:
    static constexpr std::uint32_t unwritten = ~0u;

    explicit PoolMemory(std::uint32_t capacity)
        : capacity_(capacity), words_(capacity + std::size_t{64}, unwritten) {}

    /// Valid while this stays where it is.
    [[nodiscard]] mir::LeafPool view() { return {words_.data(), capacity_, &used_}; }
    [[nodiscard]] const std::vector<std::uint32_t>& words() const { return words_; }
    [[nodiscard]] std::uint32_t capacity() const { return capacity_; }
    [[nodiscard]] std::uint32_t used() const { return used_; }
    /// False when something behind the last word was written.
    [[nodiscard]] bool is_whole() const {
        for (std::size_t i = capacity_; i < words_.size(); ++i)
            if (words_[i] != unwritten) return false;
        return true;
    }

 private:
    std::uint32_t capacity_;
    std::uint32_t used_ = 0;
    std::vector<std::uint32_t> words_;
};

}  // namespace mirtest
