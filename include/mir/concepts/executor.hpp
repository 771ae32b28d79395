// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>

namespace mir {

/// Runs independent loop bodies: the caller's threads. `for_each(n, body)` calls body(i) once for
/// every i in [0, n), in any order, possibly at the same time, and returns when all are done. An
/// exception thrown by a body reaches the caller (validation/executor.hpp).
template <class E>
concept Executor = requires(E& e, std::size_t n, void (*body)(std::size_t)) {
    e.for_each(n, body);
    { e.concurrency() } -> std::convertible_to<std::size_t>;
};

/// Runs everything on the calling thread, in order.
struct InlineExecutor {
    /// Calls body(0) to body(n - 1). An exception ends the loop there.
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        for (std::size_t i = 0; i < n; ++i) body(i);
    }
    /// Always 1.
    [[nodiscard]] std::size_t concurrency() const { return 1; }
};

}  // namespace mir
