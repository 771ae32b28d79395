// SPDX-License-Identifier: MIT
#include "runtime/draw_together.hpp"

#include "split/thread_peers.hpp"
#include "support/catch.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <thread>
#include <vector>

TEST_CASE("Processes draw each path of a bootstrap once, and all get all") {
    constexpr std::uint32_t processes = 3;
    constexpr std::size_t paths = 10'000;
    constexpr std::uint64_t first = 500;
    std::deque<mirtest::Box> boxes(processes);
    std::atomic<std::size_t> drawn = 0;
    const auto draw = [&](std::uint64_t begin, std::span<double> weights,
                          std::span<std::uint32_t> places) {
        drawn += weights.size();
        for (std::size_t i = 0; i < weights.size(); ++i) {
            weights[i] = static_cast<double>(begin + i);
            places[i] = static_cast<std::uint32_t>(2 * (begin + i));
        }
    };
    std::vector<std::vector<double>> weights(processes, std::vector<double>(paths));
    std::vector<std::vector<std::uint32_t>> places(processes, std::vector<std::uint32_t>(paths));
    {
        std::vector<std::jthread> all;
        for (std::uint32_t rank = 0; rank < processes; ++rank)
            all.emplace_back([&, rank] {
                mirtest::ThreadPeers peers(boxes, rank);
                mir::PictureShare share(peers);
                mir::draw_together(share, nullptr, {first, weights[rank], places[rank]}, draw);
            });
    }
    CHECK(drawn == paths);
    for (std::uint32_t rank = 0; rank < processes; ++rank)
        for (std::size_t i = 0; i < paths; ++i)
            if (weights[rank][i] != static_cast<double>(first + i) ||
                places[rank][i] != 2 * (first + i)) {
                CAPTURE(rank, i);
                FAIL_CHECK("a path is another one");
                break;
            }
}
