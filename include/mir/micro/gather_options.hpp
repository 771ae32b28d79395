// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace mir {

/// How the directions of a gather are spread over the hemisphere around the shading normal.
enum class GatherDirections {
    cosine,  ///< density cos / pi
    uniform  ///< density 1 / (2 pi)
};

/// As what a node is met where an approximate ray stops.
enum class StopShape {
    disc,   ///< across the axis of its cone, as large as its sphere: surfaces stay thin
    sphere  ///< its sphere, which bulges out of flat surfaces
};

/// How light is gathered at a point.
struct GatherOptions {
    std::uint32_t rays = 128;                                ///< of each point, 1 to 65536
    GatherDirections directions = GatherDirections::cosine;  ///< where rays lie dense
    /// Largest solid angle of a node at which a ray stops, in the ray's own. That is 1 / (rays *
    /// density): 0 is exact, 1 the article's choice.
    float threshold = 1.0f;
    StopShape shape = StopShape::disc;  ///< what a ray meets where it stops at a node
};

/// Which directions the texels of a micro-buffer stand for.
enum class BufferWarp {
    hemisphere,  ///< the hemisphere above the surface, by its cosine
    /// And into the lobe of glossy surfaces, by a second buffer. In a room of varying light a luxel
    /// of GGX width 0.1 has less than a quarter of the variance, at twice the work.
    importance
};

/// How light is gathered by a micro-buffer.
struct BufferGatherOptions {
    static constexpr std::uint32_t largest_side = 24;  ///< texels that a group has room for

    std::uint32_t side = 16;  ///< texels in each direction, 1 to largest_side
    /// Largest solid angle of a node that is drawn whole, in smallest texels. Those are the ones
    /// that it may cover, of those that follow the cosine pi / side^2 everywhere: 0 is exact.
    float threshold = 1.0f;
    BufferWarp warp = BufferWarp::hemisphere;  ///< what texels stand for
};

}  // namespace mir
