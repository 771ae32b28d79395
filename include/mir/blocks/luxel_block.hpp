// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/block_bounds.hpp"
#include "mir/blocks/block_list.hpp"
#include "mir/concepts/known_visibility.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/core/lanes.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/data/soa.hpp"

namespace mir::blocks {

/// Sixteen neighbouring luxels: one ray packet, one vector register of AVX-512.
inline constexpr std::uint32_t group_size = PointPacket::width;
inline constexpr std::uint32_t groups_per_block = BlockMask::packets;
static_assert(groups_per_block * group_size == BlockedLayout::block_size);

/// Calls `body` for each group of a block. Kept a loop, which compilers vectorise: once they have
/// unrolled it into sixteen numbers they do not.
template <class Body>
[[gnu::always_inline]] inline void each_group(const Body& body) {
    // nvcc does not know the pragma.
#if !defined(__CUDACC__)
#pragma GCC unroll 1
#endif
    for (std::uint32_t group = 0; group < groups_per_block; ++group) body(group);
}

/// The luxels of `view` from `first` on, in the same planes.
template <class T>
SoaView<T> starting_at(SoaView<T> view, std::uint32_t first) {
    return {view.planes + first, view.stride};
}

/// The hits of one 16x16 block, and which of its luxels count.
struct HitBlock {
    Block place;
    SoaView<const Hit> hits;
    std::uint32_t candidates[groups_per_block] = {};  ///< luxels that count, a bit each
    bool none_counts = true;                          ///< no bit is set in `candidates`

    /// One of the blocks of a tile. Luxel i of it counts if it sees something and `wanted(i)`.
    template <class Wanted>
    HitBlock(SoaView<const Hit> tile, Block b, const Wanted& wanted)
        : place(b), hits(starting_at(tile, first_luxel(b))) {
        for (std::uint32_t group = 0; group < groups_per_block; ++group) {
            const std::uint32_t first = group * group_size;
            const auto group_hits = starting_at(hits, first);
            candidates[group] = mir::detail::lanes_where([&](std::uint32_t k) {
                return (static_cast<int>(!is_empty(group_hits.load(k))) &
                        static_cast<int>(wanted(first + k))) != 0;
            });
            none_counts = none_counts && candidates[group] == 0;
        }
    }

    /// True when luxel `i` of the block counts.
    [[nodiscard]] bool counts(std::uint32_t i) const {
        return (candidates[i / group_size] >> i % group_size & 1u) != 0;
    }
};

/// The same with bounds of the luxels that count, for rejecting whole blocks.
struct BoundedHitBlock : HitBlock {
    BlockBounds bounds;

    template <class Wanted>
    BoundedHitBlock(SoaView<const Hit> tile, Block b, const Wanted& wanted)
        : HitBlock(tile, b, wanted) {
        BoundsOfLanes lanes;
        for (std::uint32_t group = 0; group < groups_per_block; ++group)
            if (candidates[group] != 0)
                lanes.add(starting_at(hits, group * group_size), candidates[group]);
        bounds = lanes.all();
    }

    /// True only if no luxel that counts faces the VPL: skipping it loses nothing.
    [[nodiscard]] bool cannot_face(const Vpl& vpl) const {
        return none_counts || bounds.behind(vpl) || bounds.turned_away_from(vpl.position);
    }
};

/// One 16x16 block ready to meet VPLs; luxels that reflect nothing do not count.
template <Shading F, class Hits = HitBlock>
struct LuxelBlock : Hits {
    SoaView<const typename F::Surface> surfaces;

    LuxelBlock(SoaView<const Hit> tile_hits, SoaView<const typename F::Surface> tile_surfaces,
               Block b, const F& shade)
        : Hits(tile_hits, b,
               [&, of_block = starting_at(tile_surfaces, first_luxel(b))](std::uint32_t i) {
                   if constexpr (SurfaceSelectiveShading<F>)
                       return shade.reflects(of_block.load(i));
                   else
                       return true;
               }),
          surfaces(starting_at(tile_surfaces, first_luxel(b))) {}
};

/// Positions of a group as the packet interface of Visibility wants them.
inline void load_points(SoaView<const Hit> group, PointPacket& points) {
    for (std::uint32_t k = 0; k < group_size; ++k) {
        const Vec3 p = group.load(k).position;
        points.x[k] = p.x;
        points.y[k] = p.y;
        points.z[k] = p.z;
    }
}

/// Bit k: luxel k of the group faces the VPL. The arithmetic is that of faces(), bit for bit;
/// empty luxels have a zero normal and never face anything.
[[gnu::always_inline]] inline std::uint32_t facing_mask(SoaView<const Hit> group, Vpl vpl) {
    return mir::detail::lanes_where([&](std::uint32_t k) {
        const Hit hit = group.load(k);
        const Vec3 d = vpl.position - hit.position;
        return (static_cast<int>(glm::dot(d, hit.normal) > 0.0f) &
                static_cast<int>(glm::dot(d, vpl.normal) < 0.0f)) != 0;
    });
}

/// Luxels of a block that count and face the VPL.
[[gnu::always_inline]] inline BlockMask facing_mask(const HitBlock& block, const Vpl& vpl) {
    BlockMask mask;
    for (std::uint32_t group = 0; group < groups_per_block; ++group)
        mask.packet[group] =
            facing_mask(starting_at(block.hits, group * group_size), vpl) & block.candidates[group];
    return mask;
}

/// Which luxels of one block count, face and see VPLs. Block and visibility must outlive it.
template <PacketVisibility V>
class BlockSight {
 public:
    BlockSight(const HitBlock& block, const V& visibility)
        : block_(block), visibility_(visibility) {}

    [[nodiscard]] BlockMask operator()(const Vpl& vpl) const {
        BlockMask mask = facing_mask(block_, vpl);
        for (std::uint32_t group = 0; group < groups_per_block; ++group) {
            std::uint32_t& lit = mask.packet[group];
            if (lit == 0) continue;
            PointPacket points;
            load_points(starting_at(block_.hits, group * group_size), points);
            lit = visibility_.visible_packet(vpl.position, points, lit);
        }
        return mask;
    }

 private:
    const HitBlock& block_;
    const V& visibility_;
};

/// Finds the luxels of the block that count and see a VPL. It knows visibility already; true if
/// there are some. Both in one go: masks are stored half a vector at a time, and who reads them as
/// one waits.
template <KnownVisibility V>
[[gnu::always_inline]] inline bool find_known(const HitBlock& block, VplIndex j, const V& known,
                                              BlockMask& lit) {
    const std::uint16_t* const masks = known.block_masks(block.place.tile, block.place.block, j);
    std::uint32_t any = 0;
    each_group([&](std::uint32_t group) {
        lit.packet[group] = masks[group] & block.candidates[group];
        any |= lit.packet[group];
    });
    return any != 0;
}

}  // namespace mir::blocks
