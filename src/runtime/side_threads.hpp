// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <exception>
#include <future>
#include <thread>
#include <vector>

namespace mir {

/// Calls body(k) for all k < n at the same time. Each has a thread of its own, body(0) the calling
/// one; waits for all. None is called where a thread cannot be had.
/// @throws What the body throws, for the least k if for several; std::system_error.
template <class Body>
void on_side_threads(std::size_t n, const Body& body) {
    std::vector<std::exception_ptr> errors(n);
    const auto call = [&](std::size_t k) {
        try {
            body(k);
        } catch (...) {
            errors[k] = std::current_exception();
        }
    };
    {
        std::promise<bool> all_are_there;
        const std::shared_future<bool> begin = all_are_there.get_future().share();
        std::vector<std::jthread> threads;
        try {
            for (std::size_t k = 1; k < n; ++k)
                threads.emplace_back([&call, begin, k] {
                    if (begin.get()) call(k);
                });
        } catch (...) {
            all_are_there.set_value(false);
            throw;
        }
        all_are_there.set_value(true);
        if (n > 0) call(0);
    }
    for (const std::exception_ptr& error : errors)
        if (error) std::rethrow_exception(error);
}

}  // namespace mir
