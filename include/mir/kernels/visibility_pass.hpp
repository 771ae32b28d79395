// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/shading/contribution.hpp"

namespace mir {

/// Whether a luxel faces and sees a VPL: the first kernel of RCVP, for fill_bits(). Reads no
/// surface, so that it runs while those are on their way (section 5.2 of the paper).
template <GBuffer G, VplSet P, Visibility V>
struct VisibilityPass {
    G luxels;      ///< only their hits are read
    P vpls;        ///< only positions and normals are read
    V visibility;  ///< asked VPL first, where both face each other

    /// What the bits of luxel `i` (blocked index) have in common, for fill_bits().
    [[nodiscard]] MIR_HD Hit row(LuxelIndex i) const { return luxels.hit(i); }

    /// True when the luxel of that row faces and sees VPL `j`. Luxels that are empty see none.
    [[nodiscard]] MIR_HD bool operator()(const Hit& hit, VplIndex j) const {
        const Vpl vpl = vpls[j];
        return faces(hit, vpl) && visibility.visible(vpl.position, hit.position);
    }
};
template <class G, class P, class V>
VisibilityPass(G, P, V) -> VisibilityPass<G, P, V>;

}  // namespace mir
