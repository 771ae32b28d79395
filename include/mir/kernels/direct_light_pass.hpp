// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/soa.hpp"
#include "mir/kernels/light_of_luxel.hpp"
#include "mir/kernels/luxel_light.hpp"

namespace mir {

/// One luxel, all lamps: writes its direct light, or black. Kernel over the luxels of a tile,
/// padding included; the bits of direct_light().
template <class G, class Light>
struct DirectLightPass {
    G luxels;                         ///< of the tile
    Tile tile;                        ///< in the band
    Light light;                      ///< LuxelLight
    SoaView<Rgb> out;                 ///< W m^-2 sr^-1 by blocked index
    const SkyGuide* skies = nullptr;  ///< of each block, or null

    /// Luxel `i` (blocked index) of the tile; black for the padding.
    MIR_HD void operator()(LuxelIndex i) const {
        out.store(i, light_of_luxel(luxels, tile, i,
                                    [&](const Hit& hit, const auto& surface, std::uint32_t x,
                                        std::uint32_t y) {
                                        return light(hit, surface, x, y, sky_of(skies, i));
                                    }));
    }
};
template <class G, class Light>
DirectLightPass(G, Tile, Light, SoaView<Rgb>, const SkyGuide*) -> DirectLightPass<G, Light>;

}  // namespace mir
