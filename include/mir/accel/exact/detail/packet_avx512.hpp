// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/detail/origin_rows.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/core/lanes.hpp"

#include <cstdint>

#if defined(__x86_64__)
#include <immintrin.h>

// What walks of packets spend their time with, in AVX-512 by hand. Of a loop over lanes GCC 12
// makes half as many instructions again: numbers that all lanes share are spread by the unit that
// compares, where a load would spread them; limits that are constants take a comparison and a
// selection; and truths wander between registers. By hand they save a sixteenth of `car`'s time
// (docs/decisions/005). GCC's intrinsics are products and sums that it may fuse like any
// other: -ffp-contract=off holds here, too. Only for processors that have these instructions.
#define MIR_AVX512 [[gnu::target("avx512f,avx512dq,avx512bw,avx512vl")]]

namespace mir::detail {

// smaller() and larger(). With a mask of all lanes: without one GCC 12 warns of its own header.
MIR_AVX512 [[gnu::always_inline]] inline __m512 smaller_512(__m512 a, __m512 b) {
    return _mm512_maskz_min_ps(__mmask16{0xFFFF}, a, b);
}
MIR_AVX512 [[gnu::always_inline]] inline __m512 larger_512(__m512 a, __m512 b) {
    return _mm512_maskz_max_ps(__mmask16{0xFFFF}, a, b);
}

/// Sixteen points.
struct Points512 {
    __m512 x;
    __m512 y;
    __m512 z;
};

MIR_AVX512 [[gnu::always_inline]] inline Points512 load_512(const PointPacket& points) {
    return {_mm512_load_ps(points.x), _mm512_load_ps(points.y), _mm512_load_ps(points.z)};
}
MIR_AVX512 [[gnu::always_inline]] inline Points512 spread_512(Vec3 p) {
    return {_mm512_set1_ps(p.x), _mm512_set1_ps(p.y), _mm512_set1_ps(p.z)};
}

/// row_at() of each, bit for bit.
MIR_AVX512 [[gnu::always_inline]] inline __m512 row_at_512(const AffineRow& row,
                                                           const Points512& p) {
    const __m512 xy = _mm512_add_ps(_mm512_mul_ps(_mm512_set1_ps(row.x), p.x),
                                    _mm512_mul_ps(_mm512_set1_ps(row.y), p.y));
    return _mm512_add_ps(_mm512_add_ps(xy, _mm512_mul_ps(_mm512_set1_ps(row.z), p.z)),
                         _mm512_set1_ps(row.w));
}

/// A triangle seen from one point: row_at() there, the same in all lanes.
struct Origin512 {
    __m512 u;
    __m512 v;
    __m512 s;
};

/// Lanes of `among` where none of the three lies below the bound.
MIR_AVX512 [[gnu::always_inline]] inline std::uint32_t lanes_above_512(__mmask16 among, __m512 u,
                                                                       __m512 v, __m512 w,
                                                                       __m512 bound) {
    __mmask16 all = _mm512_mask_cmp_ps_mask(among, u, bound, _CMP_GE_OQ);
    all = _mm512_mask_cmp_ps_mask(all, v, bound, _CMP_GE_OQ);
    return _mm512_mask_cmp_ps_mask(all, w, bound, _CMP_GE_OQ);
}

/// sort_lanes() of sixteen points, bit for bit. Where s is not negative at the origin its values at
/// both ends change their sign, and with them, exactly, all that is asked for its sign: d is
/// positive then wherever ends lie on opposite sides, and is_inside() has one side. Zeros may have
/// either sign, which no comparison sees.
MIR_AVX512 [[gnu::always_inline]] inline LaneHits sort_lanes_512(const TriangleRows& rows,
                                                                 const Origin512& from,
                                                                 const Points512& to, float doubt) {
    const __m512 sign = _mm512_set1_ps(-0.0f);
    const __m512 zero = _mm512_setzero_ps();
    const __m512 least = _mm512_set1_ps(-doubt);
    const __m512 s_from = _mm512_or_ps(from.s, sign);
    const __m512 s_to = _mm512_xor_ps(row_at_512(rows.s, to), _mm512_andnot_ps(from.s, sign));
    const __m512 u =
        _mm512_sub_ps(_mm512_mul_ps(from.u, s_to), _mm512_mul_ps(row_at_512(rows.u, to), s_from));
    const __m512 v =
        _mm512_sub_ps(_mm512_mul_ps(from.v, s_to), _mm512_mul_ps(row_at_512(rows.v, to), s_from));
    const __m512 w = _mm512_sub_ps(_mm512_sub_ps(_mm512_sub_ps(s_to, s_from), u), v);
    const __mmask16 apart = _mm512_cmp_ps_mask(_mm512_mul_ps(s_from, s_to), zero, _CMP_LT_OQ);
    return {lanes_above_512(apart, u, v, w, zero), lanes_above_512(apart, u, v, w, least)};
}

/// sort_lanes() of a packet, the triangle's rows at the origin being known.
MIR_AVX512 inline LaneHits sort_lanes_by_avx512(const TriangleRows& rows, const OriginRows& from,
                                                const PointPacket& points, float doubt) {
    const Origin512 origin{_mm512_set1_ps(from.u), _mm512_set1_ps(from.v), _mm512_set1_ps(from.s)};
    return sort_lanes_512(rows, origin, load_512(points), doubt);
}
/// The same of `Packets` packets, a bit for each lane, packet after packet. The rows at the origin
/// are found in all lanes: that takes no longer than in one, and spreads nothing.
template <std::uint32_t Packets>
MIR_AVX512 inline LaneHits sort_lanes_by_avx512(const TriangleRows& rows, Vec3 origin,
                                                const PointPacket* points, float doubt) {
    static_assert(Packets * PointPacket::width <= 32, "a word has a bit for each lane");
    const Points512 at = spread_512(origin);
    const Origin512 from{row_at_512(rows.u, at), row_at_512(rows.v, at), row_at_512(rows.s, at)};
    LaneHits all;
    for (std::uint32_t p = 0; p < Packets; ++p) {
        const LaneHits lanes = sort_lanes_512(rows, from, load_512(points[p]), doubt);
        all.hit |= lanes.hit << p * PointPacket::width;
        all.doubtful |= lanes.doubtful << p * PointPacket::width;
    }
    return all;
}

/// Lanes whose segments meet a box. They enter at its corner `near` and leave at
/// `far`. `inverse` and `offset` are those of PacketSlabs; fused, as loose::mul_sub()
/// may be.
template <bool Mixed>
MIR_AVX512 inline std::uint32_t meet_by_avx512(const LaneFloats* inverse, const LaneFloats* offset,
                                               Vec3 near, Vec3 far) {
    __m512 first = _mm512_setzero_ps();
    __m512 last = _mm512_set1_ps(1.0f);
    for (int axis = 0; axis < 3; ++axis) {
        const __m512 by = _mm512_load_ps(inverse[axis].at);
        const __m512 from = _mm512_load_ps(offset[axis].at);
        const __m512 a = _mm512_fmsub_ps(_mm512_set1_ps(near[axis]), by, from);
        const __m512 b = _mm512_fmsub_ps(_mm512_set1_ps(far[axis]), by, from);
        first = larger_512(Mixed ? smaller_512(a, b) : a, first);
        last = smaller_512(Mixed ? larger_512(a, b) : b, last);
    }
    return _mm512_cmp_ps_mask(first, last, _CMP_LE_OQ);
}

}  // namespace mir::detail

#undef MIR_AVX512
#endif
