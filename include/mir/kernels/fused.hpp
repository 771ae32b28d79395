// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/data/soa.hpp"
#include "mir/shading/contribution.hpp"
#include "mir/shading/prepared_luxel.hpp"

namespace mir {

/// One luxel, all VPLs, rays and shading in one place. The body of algorithm 3 of the paper as RC
/// runs it. Writes W m^-2 sr^-1, VPLs summed in their order.
///
/// Rays go 32 at a time before what they found is shaded: neither then occupies the registers of
/// the other, which is what bounds the number of threads that a GPU keeps in flight.
template <GBuffer G, VplSet P, Visibility V, Shading F>
struct FusedKernel {
    G luxels;               ///< of the tile
    P vpls;                 ///< summed in their order
    V visibility;           ///< asked VPL first, where both face each other
    F shade;                ///< not asked for VPLs that are hidden
    SoaView<Rgb> radiance;  ///< W m^-2 sr^-1 by blocked index

    /// Threads in flight pay more than registers. GPUs are to hold as many blocks of 256 at least.
    static constexpr std::uint32_t resident_blocks = 5;

    /// Luxel `i` (blocked index) against all VPLs; an empty luxel gets black.
    MIR_HD void operator()(LuxelIndex i) const {
        const Hit hit = luxels.hit(i);
        if (is_empty(hit)) return radiance.store(i, {});
        constexpr VplIndex width = 32;
        Rgb sum;
        for (VplIndex first = 0; first < vpls.size(); first += width) {
            const VplIndex last = vpls.size() - first < width ? vpls.size() : first + width;
            const std::uint32_t seen = seen_from(hit, first, last);
            if (seen != 0) sum = shaded(i, hit, first, last, seen, sum);
        }
        radiance.store(i, sum);
    }

 private:
    /// Bit k is set where the luxel faces and sees VPL first + k.
    [[nodiscard]] MIR_HD std::uint32_t seen_from(const Hit& hit, VplIndex first,
                                                 VplIndex last) const {
        std::uint32_t seen = 0;
        for (VplIndex j = first; j < last; ++j) {
            const Vpl vpl = vpls[j];
            if (faces(hit, vpl) && visibility.visible(vpl.position, hit.position))
                seen |= 1u << (j - first);
        }
        return seen;
    }

    [[nodiscard]] MIR_HD Rgb shaded(LuxelIndex i, const Hit& hit, VplIndex first, VplIndex last,
                                    std::uint32_t seen, Rgb sum) const {
        const auto luxel = PreparedLuxel<F>::of(shade, hit, luxels.surface(i));
        for (VplIndex j = first; j < last; ++j)
            if ((seen >> (j - first) & 1u) != 0) sum += luxel.lit_by(vpls[j], shade);
        return sum;
    }
};
template <class G, class P, class V, class F>
FusedKernel(G, P, V, F, SoaView<Rgb>) -> FusedKernel<G, P, V, F>;

}  // namespace mir
