// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/luxel_block.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/core/instruction_set.hpp"
#include "mir/core/lanes.hpp"
#include "mir/data/soa.hpp"

namespace mir::blocks {

/// Radiance of the luxels of a group, structure of arrays. VPLs are added to it.
struct alignas(64) GroupRadiance {
    float r[group_size] = {};
    float g[group_size] = {};
    float b[group_size] = {};
};

/// Luxels of a group that are shaded together: `Lanes` from lane `First` on. Types, because only
/// for places that it knows does a compiler keep sums in registers.
template <std::uint32_t First, std::uint32_t Lanes>
struct LaneRun {
    static constexpr std::uint32_t first = First;
    static constexpr bool is_last = First + Lanes == group_size;
    using Next = LaneRun<First + Lanes, Lanes>;
};

/// Lanes of one vector register. Where a group is several, compilers loop over them inside of the
/// loop over VPLs, which then repeats for each VPL what depends on the luxel alone.
constexpr std::uint32_t lanes_shaded_by(InstructionSet set) {
    if (set == InstructionSet::avx512) return 16;
    return set == InstructionSet::avx2 ? 8 : 4;
}

/// Ways from each luxel of a run to a VPL, and their inverse distances.
struct WaysAhead {
    mir::detail::LaneFloats x;        ///< metres
    mir::detail::LaneFloats y;        ///< metres
    mir::detail::LaneFloats z;        ///< metres
    mir::detail::LaneFloats inverse;  ///< 1/d, m^-1

    /// Sets those of luxel `k`.
    template <DistanceShading F>
    [[gnu::always_inline]] void find(std::uint32_t k, const Hit& hit, const Vpl& vpl) {
        const Vec3 offset = vpl.position - hit.position;
        x.at[k] = offset.x;
        y.at[k] = offset.y;
        z.at[k] = offset.z;
        inverse.at[k] = F::inverse_distance(offset);
    }
};

/// Finds the ways to a VPL and their inverse distances.
template <DistanceShading F, std::uint32_t First, std::uint32_t Lanes>
[[gnu::always_inline]] inline void find_ways(LaneRun<First, Lanes>, SoaView<const Hit> hits,
                                             Vpl vpl, WaysAhead& ahead) {
    for (std::uint32_t k = 0; k < Lanes; ++k) ahead.find<F>(k, hits.load(k), vpl);
}

/// Adds the VPL to the luxels of a run whose `lit` bit is set. Every lane is computed, so that the
/// loop becomes one pass over vector registers. A root and a quotient wait for one another at the
/// beginning of most shadings, and no processor looks far enough ahead to begin with the next VPL
/// meanwhile: a DistanceShading finds ways and inverse distances of this VPL in `ahead`, which is
/// then given those of the `next`.
template <std::uint32_t First, std::uint32_t Lanes, Shading F>
[[gnu::always_inline]] inline void add_shaded(LaneRun<First, Lanes>, SoaView<const Hit> hits,
                                              SoaView<const typename F::Surface> surfaces, Vpl vpl,
                                              Vpl next, F shade, std::uint32_t lit,
                                              WaysAhead& __restrict ahead,
                                              GroupRadiance& __restrict sum) {
    // Without the promise that the sum is no input, a compiler takes the lanes one by one.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (std::uint32_t k = 0; k < Lanes; ++k) {
        Rgb c;
        if constexpr (DistanceShading<F>) {
            const Vec3 offset{ahead.x.at[k], ahead.y.at[k], ahead.z.at[k]};
            const float inverse = ahead.inverse.at[k];
            ahead.find<F>(k, hits.load(k), next);
            c = shade.at_distance(hits.load(k), surfaces.load(k), vpl, offset, inverse);
        } else {
            c = shade(hits.load(k), surfaces.load(k), vpl);
        }
        const bool on = (lit & mir::detail::lane_bits[First + k]) != 0;
        float& r = sum.r[First + k];
        float& g = sum.g[First + k];
        float& b = sum.b[First + k];
        r = on ? r + c.r : r;
        g = on ? g + c.g : g;
        b = on ? b + c.b : b;
    }
}

}  // namespace mir::blocks
