// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/data/soa.hpp"
#include "mir/shading/contribution.hpp"

namespace mir {

/// One luxel, all VPLs, rays and shading in one place: the body of algorithm 3 of the paper as RC
/// runs it. Writes W m^-2 sr^-1, VPLs summed in their order.
template <GBuffer G, VplSet P, Visibility V, Shading F>
struct FusedKernel {
    G luxels;
    P vpls;
    V visibility;
    F shade;
    SoaView<Rgb> radiance;

    MIR_HD void operator()(LuxelIndex i) const {
        const Hit hit = luxels.hit(i);
        if (is_empty(hit)) return radiance.store(i, {});
        const auto surface = luxels.surface(i);
        Rgb sum;
        for (VplIndex j = 0; j < vpls.size(); ++j)
            sum += contribution(hit, surface, vpls[j], visibility, shade);
        radiance.store(i, sum);
    }
};
template <class G, class P, class V, class F>
FusedKernel(G, P, V, F, SoaView<Rgb>) -> FusedKernel<G, P, V, F>;

}  // namespace mir
