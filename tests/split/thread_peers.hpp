// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/peers.hpp"

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace mirtest {

/// What was sent to a process and is not received.
struct Box {
    std::mutex mutex;
    std::deque<mir::Peers::Letter> letters;
};

/// Threads as processes that talk, each with a box.
class ThreadPeers final : public mir::Peers {
 public:
    ThreadPeers(std::deque<Box>& boxes, std::uint32_t rank) : boxes_(boxes), rank_(rank) {}
    [[nodiscard]] std::uint32_t rank() const override { return rank_; }
    [[nodiscard]] std::uint32_t count() const override {
        return static_cast<std::uint32_t>(boxes_.size());
    }
    void send(std::uint32_t to, const Bytes& message) override {
        const std::lock_guard lock(boxes_[to].mutex);
        boxes_[to].letters.push_back({rank_, message});
    }
    [[nodiscard]] std::optional<Letter> receive() override {
        const std::lock_guard lock(boxes_[rank_].mutex);
        if (boxes_[rank_].letters.empty()) return std::nullopt;
        Letter letter = std::move(boxes_[rank_].letters.front());
        boxes_[rank_].letters.pop_front();
        return letter;
    }

 private:
    std::deque<Box>& boxes_;
    std::uint32_t rank_;
};

}  // namespace mirtest
