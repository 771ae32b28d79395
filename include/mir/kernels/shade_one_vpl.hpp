// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/data/soa.hpp"
#include "mir/shading/contribution.hpp"

namespace mir {

/// One luxel, one VPL, as if nothing stood between them: the kernel of OS. Black where they do not
/// face each other. Writes W m^-2 sr^-1.
template <GBuffer G, VplSet P, Shading F>
struct ShadeOneVpl {
    G luxels;               ///< of the tile
    P vpls;                 ///< one of them is read
    VplIndex vpl = 0;       ///< its place in `vpls`
    F shade;                ///< asked where luxel and VPL face each other
    SoaView<Rgb> radiance;  ///< W m^-2 sr^-1 by blocked index

    /// Luxel `i` (blocked index); an empty one gets black.
    MIR_HD void operator()(LuxelIndex i) const {
        const Hit hit = luxels.hit(i);
        const Vpl light = vpls[vpl];
        if (is_empty(hit) || !faces(hit, light)) return radiance.store(i, {});
        radiance.store(i, shade(hit, luxels.surface(i), light));
    }
};
template <class G, class P, class F>
ShadeOneVpl(G, P, VplIndex, F, SoaView<Rgb>) -> ShadeOneVpl<G, P, F>;

}  // namespace mir
