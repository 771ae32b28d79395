// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/micro/cosine_texels.hpp"
#include "mir/micro/lobe_texels.hpp"
#include "mir/micro/surfel_traverse.hpp"
#include "mir/micro/texel_rectangle.hpp"

namespace mir {

/// A point whose picture is drawn.
template <class Texels>
struct MicroPoint {
    Vec3 origin{0};  ///< metres
    Vec3 normal{0};  ///< of the tangent plane below which nothing is seen (SurfelRay::normal)
    Texels texels;   ///< directions, a CosineTexels or LobeTexels
    Vec2 jitter{0};  ///< place of the directions inside their texels, [0, 1)^2
};

/// Workspace of a group that draws MicroBuffers. They have up to `Side` texels in each direction;
/// `Lobes`: those of LobeTexels too. Nodes wait on a stack of `Waiting` places: fewer make lanes
/// idle, never fail; more leave room for fewer groups.
template <std::uint32_t Side, bool Lobes = true, std::uint32_t Waiting = 320>
struct MicroBufferSpace {
    /// What waits when nodes are taken one at a time. Up to 63 that were unsure before, and one for
    /// each step of a walk down.
    static constexpr std::uint32_t reserve = 2 * LaneGroup::width + SurfelTreeOptions::depth_limit;
    static_assert(Waiting > reserve);
    /// Nodes whose children may wait before nodes are taken one at a time.
    static constexpr std::uint32_t room = Waiting - reserve;

    static constexpr std::uint32_t side = Side;  ///< most texels in each direction
    /// Pictures that are drawn at once. As many as leave a GPU room for enough groups.
    static constexpr std::uint32_t pictures = Side <= 8 ? 4 : 1;

    /// Nodes and for which pictures, a bit each, something is to be done with them.
    template <std::uint32_t N>
    struct Shares {
        std::uint32_t node[N];     ///< indices
        std::uint8_t pictures[N];  ///< bit k: picture k
    };
    /// Nodes whose children come next.
    struct Parents : Shares<Waiting> {
        std::uint32_t right[Waiting];  ///< index of the right child
    };
    /// A node where the walk for a picture ended.
    struct Drawn {
        std::uint32_t node;     ///< index
        TexelRectangle texels;  ///< that it may cover, one at least
    };
    /// The same, made ready to be met.
    struct alignas(16) Met {
        detail::SeenDisc disc;  ///< as its point sees it
        TexelRectangle texels;  ///< that it may cover
        std::uint32_t before;   ///< texels of the nodes before
    };

    MicroPoint<CosineTexels> even[pictures];             ///< of pictures of the hemisphere
    MicroPoint<LobeTexels> sharp[Lobes ? pictures : 1];  ///< of pictures of a lobe
    Rgb light[pictures];                                 ///< the caller's
    std::uint64_t nearest[pictures][Side * Side];  ///< bits of the distance, below them the node
    Vec3 direction[pictures][Side * Side];         ///< of texels, unit
    Parents waiting;                               ///< a stack
    Shares<2 * LaneGroup::width> unsure;           ///< nodes that each picture has to look at
    Shares<2 * LaneGroup::width> ended;            ///< nodes that are to be drawn
    Drawn drawn[2 * LaneGroup::width];             ///< the same, texels known
    Met met[LaneGroup::width];                     ///< nodes that are met together
};

}  // namespace mir
