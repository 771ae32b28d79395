// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cstring>
#include <type_traits>

namespace mir {

/// A copy of a value that nobody writes meanwhile. On the device it is read by 16 bytes: a compiler
/// that sees which members are used reads them one by one, and where every lane reads elsewhere
/// the cache is busy with each.
template <class T>
[[nodiscard]] MIR_HD T load_whole(const T& from) {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) % 16 == 0);
#if defined(__CUDA_ARCH__)
    constexpr int pieces = sizeof(T) / sizeof(uint4);
    uint4 words[pieces];
    for (int i = 0; i < pieces; ++i) words[i] = __ldg(reinterpret_cast<const uint4*>(&from) + i);
    T value;
    memcpy(&value, words, sizeof(T));
    return value;
#else
    return from;
#endif
}

}  // namespace mir
