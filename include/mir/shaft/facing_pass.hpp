// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/vpl_set.hpp"
#include "mir/data/soa.hpp"
#include "mir/shading/contribution.hpp"

namespace mir {

/// Whether a luxel faces a VPL, seen or not: what shafts start from, for fill_bits().
template <VplSet P>
struct FacingPass {
    SoaView<const Hit> hits;
    P vpls;

    [[nodiscard]] MIR_HD Hit row(std::uint32_t i) const { return hits.load(i); }
    [[nodiscard]] MIR_HD bool operator()(const Hit& hit, VplIndex j) const {
        return faces(hit, vpls[j]);
    }
};

}  // namespace mir
