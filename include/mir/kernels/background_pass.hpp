// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/blocked_layout.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"
#include "mir/film/luxel_rays.hpp"
#include "mir/scene/environment_view.hpp"

namespace mir {

/// Kernel over the luxels of a tile, padding included: writes the environment where luxels see
/// nothing else.
template <class G, Space S>
struct BackgroundPass {
    G luxels;                        ///< of the tile
    Tile tile;                       ///< in the band
    std::uint32_t first_row = 0;     ///< of the band
    LuxelRays rays;                  ///< of the whole image
    EnvironmentView<S> environment;  ///< in the memory where the kernel runs
    SoaView<Rgb> out;  ///< W m^-2 sr^-1; luxels that see a surface are left as they are

    /// Luxel `i` (blocked index) of the tile.
    MIR_HD void operator()(LuxelIndex i) const {
        const LuxelPlace at = BlockedLayout::of(tile).place(i);
        if (at.x >= tile.width || at.y >= tile.height || !is_empty(luxels.hit(i))) return;
        const Ray ray = rays(tile.x + at.x, first_row + tile.y + at.y);
        out.store(i, environment.radiance(ray.direction));
    }
};
template <class G, Space S>
BackgroundPass(G, Tile, std::uint32_t, LuxelRays, EnvironmentView<S>, SoaView<Rgb>)
    -> BackgroundPass<G, S>;

}  // namespace mir
