// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <cstddef>
#include <cstdint>
#include <new>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MIRTEST_FINDS_LEAKS
#include <sanitizer/lsan_interface.h>
#endif
#endif

namespace mirtest {

/// While it exists memory may leak: OpenEXR does not give all of it back when its constructors run
/// out of it.
class LeaksOfOthers {
#ifdef MIRTEST_FINDS_LEAKS
    __lsan::ScopedDisabler disabled_;
#endif
};

/// While it exists, the `n`-th call of operator new in this thread, counted from 1, throws
/// std::bad_alloc: once, as later ones may succeed where memory is scarce. One at a time in a
/// thread. What libraries get from malloc() is not concerned, nor is what Embree 3.13 asks for:
/// where its build runs out of memory, a later build may write into memory that is no longer its
/// own.
class AllocationFault {
 public:
    explicit AllocationFault(std::uint64_t n);
    AllocationFault(const AllocationFault&) = delete;
    AllocationFault& operator=(const AllocationFault&) = delete;
    ~AllocationFault();

    /// Whether there were so many calls.
    [[nodiscard]] bool struck() const;
};

/// The largest number of bytes that one call of operator new in this thread asked for since the
/// object was made. One at a time in a thread.
class LargestAllocation {
 public:
    LargestAllocation();
    [[nodiscard]] std::size_t bytes() const;
};

/// Whether an error that memory caused says so, and does not blame the input.
inline bool is_fair(const mir::Error& error) {
    return error.code() == mir::ErrorCode::limit_exceeded || error.code() == mir::ErrorCode::io ||
           error.code() == mir::ErrorCode::device;
}

/// What became of work whose allocations were made to fail.
struct FailedAllocations {
    std::uint64_t tried = 0;
    std::uint64_t survived = 0;  ///< done all the same, as by sorting without a buffer
};

/// Calls work() with its first, second, third, ... allocation failing until it has none left to
/// fail, every one up to `all` and then every `step`-th. It has to be done, or to end by
/// std::bad_alloc or by a mir::Error that does not blame its input; any other exception flies. Each
/// time, look(done) looks at what it left.
template <class Work, class Look>
FailedAllocations fail_allocations(std::uint64_t all, std::uint64_t step, const Work& work,
                                   const Look& look) {
    FailedAllocations result;
    for (std::uint64_t n = 1;; n += n < all ? 1 : step) {
        bool done = false;
        bool struck = false;
        {
            const AllocationFault fault(n);
            try {
                work();
                done = true;
            } catch (const std::bad_alloc&) {
            } catch (const mir::Error& error) {
                if (!is_fair(error)) throw;
            }
            struck = fault.struck();
        }
        look(done);
        if (!struck) return result;
        ++result.tried;
        result.survived += done ? 1 : 0;
    }
}

}  // namespace mirtest
