// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace mir {

/// Standard allocator whose containers leave new elements unwritten, where no value is given. Who
/// fills them touches their pages first, on as many threads as they like. For plain values only.
/// Thread-safe.
template <class T>
struct RawAllocator : std::allocator<T> {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

    /// The allocator of another type, as the standard asks for it.
    template <class U>
    struct rebind {  // NOLINT(readability-identifier-naming): the standard's name
        using other = RawAllocator<U>;  ///< the allocator of U
    };

    RawAllocator() = default;
    /// All are equal: what one allocates, any other may free.
    template <class U>
    RawAllocator(const RawAllocator<U>& /*other*/) {}

    /// Default initialisation of plain values: writes nothing.
    template <class U>
    void construct(U* /*place*/) noexcept {}
    /// Writes an element made of `arguments`.
    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        std::construct_at(place, std::forward<Arguments>(arguments)...);
    }
};

}  // namespace mir
