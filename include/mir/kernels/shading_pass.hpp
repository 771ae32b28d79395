// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/data/soa.hpp"
#include "mir/shading/prepared_luxel.hpp"

namespace mir {

/// One luxel, all VPLs that it is known to see: the second kernel of RCVP. `seen.sees(i, j)` is
/// true where luxel i faces and sees VPL j. Writes W m^-2 sr^-1, VPLs summed in their order.
template <GBuffer G, VplSet P, class Seen, Shading F>
struct ShadingPass {
    G luxels;               ///< of the tile
    P vpls;                 ///< those that `seen` knows of, in its order
    Seen seen;              ///< visibility of the tile's luxels
    F shade;                ///< asked for pairs that see each other
    SoaView<Rgb> radiance;  ///< W m^-2 sr^-1 by blocked index

    /// Luxel `i` (blocked index); an empty one gets black.
    MIR_HD void operator()(LuxelIndex i) const {
        const Hit hit = luxels.hit(i);
        if (is_empty(hit)) return radiance.store(i, {});
        const auto luxel = PreparedLuxel<F>::of(shade, hit, luxels.surface(i));
        Rgb sum;
        for (VplIndex j = 0; j < vpls.size(); ++j)
            if (seen.sees(i, j)) sum += luxel.lit_by(vpls[j], shade);
        radiance.store(i, sum);
    }
};
template <class G, class P, class Seen, class F>
ShadingPass(G, P, Seen, F, SoaView<Rgb>) -> ShadingPass<G, P, Seen, F>;

}  // namespace mir
