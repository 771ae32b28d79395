// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/instruction_set.hpp"

#include <array>
#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace mir::detail {

// Loops over sixteen lanes without branches: compilers make vector instructions of the caller's
// instruction set of them (core/instruction_set.hpp). What they do not find by themselves is how
// truths of lanes become the bits of a word.

inline constexpr std::uint32_t lane_count = 16;

/// Bit k of lane k, from memory. Not every instruction set shifts lanes by different counts.
inline constexpr auto lane_bits = [] {
    std::array<std::uint32_t, lane_count> bits{};
    for (std::uint32_t k = 0; k < lane_count; ++k) bits[k] = 1u << k;
    return bits;
}();

/// A number per lane.
struct alignas(64) LaneFloats {
    float at[lane_count];
};

/// A truth per lane: 0 or -1.
struct alignas(64) LaneTruths {
    std::int32_t at[lane_count];
};

#if defined(__SSE2__)
/// Bit k: lane k is true. By the instructions that every x86-64 has, which pack 32 bits to 8 and
/// gather signs; what surrounds them may use wider ones.
inline std::uint32_t bits_of(const LaneTruths& truths) {
    const auto quad = [&](std::size_t k) {
        return _mm_load_si128(reinterpret_cast<const __m128i*>(truths.at + 4 * k));
    };
    const __m128i low = _mm_packs_epi32(quad(0), quad(1));
    const __m128i high = _mm_packs_epi32(quad(2), quad(3));
    return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(low, high)));
}
#else
/// Bit k: lane k is true.
inline std::uint32_t bits_of(const LaneTruths& truths) {
    std::uint32_t bits = 0;
    for (std::uint32_t k = 0; k < lane_count; ++k)
        bits |= static_cast<std::uint32_t>(truths.at[k]) & 1u << k;
    return bits;
}
#endif

/// A truth for each child of a wide node, which are half as many.
struct alignas(32) SlotTruths {
    static constexpr std::uint32_t count = lane_count / 2;
    std::int32_t at[count];
};

#if defined(__SSE2__)
/// Bit k: slot k is true.
inline std::uint32_t bits_of(const SlotTruths& truths) {
    const auto* quads = reinterpret_cast<const __m128i*>(truths.at);
    const __m128i words = _mm_packs_epi32(_mm_load_si128(quads), _mm_load_si128(quads + 1));
    return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(words, words))) & 0xFFu;
}
#else
/// Bit k: slot k is true.
inline std::uint32_t bits_of(const SlotTruths& truths) {
    std::uint32_t bits = 0;
    for (std::uint32_t k = 0; k < SlotTruths::count; ++k)
        bits |= static_cast<std::uint32_t>(truths.at[k]) & 1u << k;
    return bits;
}
#endif

#if defined(__x86_64__)
/// The same by AVX-512, which has the bits as soon as it has the truths. Whoever calls them may use
/// these instructions.
[[gnu::target("avx512f,avx512dq,avx512bw,avx512vl")]] inline std::uint32_t bits_by_avx512(
    const LaneTruths& truths) {
    return _mm512_movepi32_mask(_mm512_load_si512(truths.at));
}
/// The same.
[[gnu::target("avx512f,avx512dq,avx512bw,avx512vl")]] inline std::uint32_t bits_by_avx512(
    const SlotTruths& truths) {
    return _mm256_movepi32_mask(_mm256_load_si256(reinterpret_cast<const __m256i*>(truths.at)));
}
#endif

/// Bit k: lane or slot k is true. By instructions of `Set`, for which the caller is compiled.
template <InstructionSet Set, class Truths>
std::uint32_t bits_of(const Truths& truths) {
#if defined(__x86_64__)
    if constexpr (Set == InstructionSet::avx512) return bits_by_avx512(truths);
#endif
    return bits_of(truths);
}

/// One bit per lane: lane k where `test(k)`. A test without branches, `&` instead of `&&`, makes
/// one loop of it.
template <InstructionSet Set = InstructionSet::baseline, class Test>
std::uint32_t lanes_where(const Test& test) {
    LaneTruths truths;
    for (std::uint32_t k = 0; k < lane_count; ++k) truths.at[k] = test(k) ? -1 : 0;
    return bits_of<Set>(truths);
}

/// Takes the lowest bit of a word that has one: its number.
inline std::uint32_t pop_lowest(std::uint32_t& bits) {
    const auto k = static_cast<std::uint32_t>(__builtin_ctz(bits));
    bits &= bits - 1;
    return k;
}

/// The same with the highest.
inline std::uint32_t pop_highest(std::uint32_t& bits) {
    const auto k = 31u - static_cast<std::uint32_t>(__builtin_clz(bits));
    bits ^= 1u << k;
    return k;
}

}  // namespace mir::detail
