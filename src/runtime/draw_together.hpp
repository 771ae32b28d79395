// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/bootstrap.hpp"
#include "runtime/picture_share.hpp"

#include <cstdint>
#include <span>

namespace mir {

/// Paths of a bootstrap that are to be drawn.
struct PathsToDraw {
    std::uint64_t first = 0;          ///< number of the first
    std::span<double> weights;        ///< of each, to be filled in
    std::span<std::uint32_t> places;  ///< as many
};

/// Draws paths by all processes of a team, each some of them, until each has all. `monitor` may be
/// null.
/// @throws As PictureShare::run().
void draw_together(PictureShare& share, Monitor* monitor, const PathsToDraw& paths,
                   const PathDraw& draw);

}  // namespace mir
