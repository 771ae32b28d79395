// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <cstdint>
#include <cstring>

namespace mir::detail {

// The three axes side by side in one register; the fourth lane is spare. Vector extensions of g++
// and clang: plain + - * / and selects, the same bits on every processor.
using Float4 [[gnu::vector_size(16)]] = float;
using Int4 [[gnu::vector_size(16)]] = std::int32_t;

inline Float4 load_lanes(const float* from) {
    Float4 v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

inline void store_lanes(Float4 v, float* to) { std::memcpy(to, &v, sizeof v); }

inline Float4 all_lanes(float x) { return Float4{x, x, x, x}; }
inline Float4 lanes_of(Vec3 v) { return Float4{v.x, v.y, v.z, 0.0f}; }

inline Float4 smaller_lanes(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 larger_lanes(Float4 a, Float4 b) { return a > b ? a : b; }

/// y, z, x and z, x, y: the other two axes of each.
inline Float4 next_axes(Float4 v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); }
inline Float4 last_axes(Float4 v) { return __builtin_shufflevector(v, v, 2, 0, 1, 3); }

inline Int4 bits_of(Float4 v) {
    Int4 bits;
    std::memcpy(&bits, &v, sizeof bits);
    return bits;
}

inline Float4 floats_of(Int4 bits) {
    Float4 v;
    std::memcpy(&v, &bits, sizeof v);
    return v;
}

/// Zero in the spare lane.
inline Float4 axes_only(Float4 v) { return floats_of(bits_of(v) & Int4{-1, -1, -1, 0}); }

/// Clears the last bit of every number: rounding towards zero by one unit at most.
inline Float4 even_lanes(Float4 v) { return floats_of(bits_of(v) & -2); }

/// Even integers in the order of numbers whose last bit is zero.
inline Int4 ordered_keys(Float4 v) {
    const Int4 bits = bits_of(v);
    return bits ^ ((bits >> 31) & 0x7FFFFFFE);
}
inline Float4 numbers_of(Int4 keys) { return floats_of(keys ^ ((keys >> 31) & 0x7FFFFFFE)); }

/// The same for one number.
inline std::int32_t ordered_key(float x) { return ordered_keys(all_lanes(x))[0]; }
inline float number_of(std::int32_t key) { return numbers_of(Int4{} + key)[0]; }

}  // namespace mir::detail
