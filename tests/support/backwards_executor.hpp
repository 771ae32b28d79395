// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <thread>
#include <vector>

namespace mirtest {

/// Runs bodies on threads of its own, each taking every `threads`-th index, the last ones first.
struct BackwardsExecutor {
    std::size_t threads = 1;

    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        std::vector<std::thread> workers;
        for (std::size_t w = 0; w < threads; ++w)
            workers.emplace_back([&, w] {
                for (std::size_t i = n; i-- > 0;)
                    if (i % threads == w) body(i);
            });
        for (std::thread& worker : workers) worker.join();
    }
    [[nodiscard]] std::size_t concurrency() const { return threads; }
};

}  // namespace mirtest
