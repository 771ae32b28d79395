// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"

namespace mir {

/// Waits at its end for all work given to a queue. Declared behind the memory that the work uses,
/// it keeps that memory until then, also when an exception ends the scope. Whether the work went
/// well an event must tell before: an end cannot.
template <class Queue>
class WaitAtEnd {
 public:
    /// `queue` must outlive it.
    explicit WaitAtEnd(Queue& queue) : queue_(queue) {}
    WaitAtEnd(const WaitAtEnd&) = delete;
    WaitAtEnd& operator=(const WaitAtEnd&) = delete;
    ~WaitAtEnd() {
        try {
            queue_.record().sync();
        } catch (...) {  // what failed is on its way to the caller already
        }
    }

 private:
    Queue& queue_;
};

}  // namespace mir
