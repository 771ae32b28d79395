// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/known_visibility.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/core/lanes.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/data/soa.hpp"
#include "mir/sched/detail/block_list.hpp"

#include <array>
#include <limits>

namespace mir::sched::detail {

/// Sixteen neighbouring luxels: one vector register, one ray packet.
inline constexpr std::uint32_t group_size = PointPacket::width;
inline constexpr std::uint32_t groups_per_block = BlockMask::packets;
static_assert(groups_per_block * group_size == BlockedLayout::block_size);

/// Radiance of the luxels of a group while VPLs are added to it, structure of arrays.
struct alignas(64) GroupRadiance {
    float r[group_size] = {};
    float g[group_size] = {};
    float b[group_size] = {};
};

/// What the luxels of a block have in common, for tests that throw whole blocks away. Every test is
/// lossless: it is true only if faces() is false for every luxel of the block.
struct BlockBounds {
    Vec3 low{std::numeric_limits<float>::max()};  ///< corners of a box around the positions
    Vec3 high{std::numeric_limits<float>::lowest()};
    Vec3 normal_low{1.0f};  ///< and of one around the normals
    Vec3 normal_high{-1.0f};
    bool empty = true;

    void add(const Hit& hit) {
        low = glm::min(low, hit.position);
        high = glm::max(high, hit.position);
        normal_low = glm::min(normal_low, hit.normal);
        normal_high = glm::max(normal_high, hit.normal);
        empty = false;
    }

    /// True when every luxel lies behind the VPL's tangent plane.
    [[nodiscard]] bool behind(const Vpl& vpl) const {
        return largest_dot(low - vpl.position, high - vpl.position, vpl.normal, vpl.normal) <
               -rounding(vpl.position);
    }

    /// True when the VPL lies behind every luxel's tangent plane.
    [[nodiscard]] bool turned_away_from(Vec3 position) const {
        return largest_dot(position - high, position - low, normal_low, normal_high) <
               -rounding(position);
    }

    /// Squared distance from a point to the box.
    [[nodiscard]] float distance_squared(Vec3 p) const {
        return length_squared(glm::max(glm::max(low - p, p - high), Vec3(0.0f)));
    }

 private:
    /// Upper bound of a dot product of two vectors that lie in boxes, by interval arithmetic.
    static float largest_dot(Vec3 a_low, Vec3 a_high, Vec3 b_low, Vec3 b_high) {
        const Vec3 largest = glm::max(glm::max(a_low * b_low, a_low * b_high),
                                      glm::max(a_high * b_low, a_high * b_high));
        return largest.x + largest.y + largest.z;
    }

    /// More than the rounding of the bound above and of the dot products in faces() together: both
    /// are sums of three products of differences, each off by a few units of the coordinates' last
    /// place.
    [[nodiscard]] float rounding(Vec3 position) const {
        return 64.0f * 0x1p-24f * (max_abs(low) + max_abs(high) + max_abs(position));
    }
};

/// The luxels of `view` from `first` on, in the same planes.
template <class T>
SoaView<T> starting_at(SoaView<T> view, std::uint32_t first) {
    return {view.planes + first, view.stride};
}

/// The hits of one 16x16 block, and which of its luxels count.
struct HitBlock {
    Block place;
    SoaView<const Hit> hits;
    BlockBounds bounds;
    std::uint32_t candidates[groups_per_block] = {};  ///< luxels that count, a bit each

    /// One of the blocks of a tile; luxel i of it counts if it sees something and `wanted(i)`.
    template <class Wanted>
    HitBlock(SoaView<const Hit> tile, Block b, const Wanted& wanted)
        : place(b), hits(starting_at(tile, first_luxel(b))) {
        for (std::uint32_t i = 0; i < BlockedLayout::block_size; ++i) {
            const Hit hit = hits.load(i);
            if (is_empty(hit) || !wanted(i)) continue;
            bounds.add(hit);
            candidates[i / group_size] |= 1u << (i % group_size);
        }
    }

    /// True when luxel `i` of the block counts.
    [[nodiscard]] bool counts(std::uint32_t i) const {
        return (candidates[i / group_size] >> i % group_size & 1u) != 0;
    }

    /// True only if no luxel that counts faces the VPL: skipping it loses nothing.
    [[nodiscard]] bool cannot_face(const Vpl& vpl) const {
        return bounds.empty || bounds.behind(vpl) || bounds.turned_away_from(vpl.position);
    }
};

/// One 16x16 block ready to meet VPLs; luxels that reflect nothing do not count.
template <Shading F>
struct LuxelBlock : HitBlock {
    SoaView<const typename F::Surface> surfaces;

    LuxelBlock(SoaView<const Hit> tile_hits, SoaView<const typename F::Surface> tile_surfaces,
               Block b, const F& shade)
        : HitBlock(tile_hits, b,
                   [&](std::uint32_t i) {
                       if constexpr (SurfaceSelectiveShading<F>)
                           return shade.reflects(tile_surfaces.load(first_luxel(b) + i));
                       else
                           return true;
                   }),
          surfaces(starting_at(tile_surfaces, first_luxel(b))) {}
};

/// Positions of a group as the packet face of Visibility wants them.
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
    BlockSight(const HitBlock& block, const V& visibility, InstructionSet)
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

/// The same by the block face; `set` is for its loops.
template <BlockVisibility V>
class BlockSight<V> {
 public:
    BlockSight(const HitBlock& block, const V& visibility, InstructionSet set)
        : block_(block), visibility_(visibility), known_(visibility.block(block.hits, set)) {}

    [[nodiscard]] BlockMask operator()(const Vpl& vpl) const {
        BlockMask mask = facing_mask(block_, vpl);
        if (mask.any()) visibility_.visible_block(known_, vpl.position, mask);
        return mask;
    }

 private:
    const HitBlock& block_;
    const V& visibility_;
    typename V::Block known_;
};

/// Luxels of a group that count and see a VPL, from what is known. `V` keeps masks of groups of
/// sixteen.
template <KnownVisibility V>
std::uint32_t known_mask(const HitBlock& block, std::uint32_t group, VplIndex j, const V& known) {
    return known.mask(block.place.tile, block.place.block * groups_per_block + group, j) &
           block.candidates[group];
}

/// The same for the whole block.
template <KnownVisibility V>
BlockMask known_mask(const HitBlock& block, VplIndex j, const V& known) {
    BlockMask mask;
    for (std::uint32_t group = 0; group < groups_per_block; ++group)
        mask.packet[group] = known_mask(block, group, j, known);
    return mask;
}

/// Bit k of lane k, from memory: not every instruction set shifts lanes by different counts.
inline constexpr auto lane_bits = [] {
    std::array<std::uint32_t, group_size> bits{};
    for (std::uint32_t k = 0; k < group_size; ++k) bits[k] = 1u << k;
    return bits;
}();

/// Adds the VPL to the luxels of a group whose bit is set in `lit`. Every lane is computed and
/// unlit ones add zero: the loop becomes one pass over vector registers.
template <Shading F>
[[gnu::always_inline]] inline void add_shaded(SoaView<const Hit> hits,
                                              SoaView<const typename F::Surface> surfaces, Vpl vpl,
                                              F shade, std::uint32_t lit,
                                              GroupRadiance& __restrict sum) {
    // Without the promise that the sum is no input, a compiler takes the lanes one by one.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (std::uint32_t k = 0; k < group_size; ++k) {
        const Rgb c = shade(hits.load(k), surfaces.load(k), vpl);
        const bool on = (lit & lane_bits[k]) != 0;
        sum.r[k] += on ? c.r : 0.0f;
        sum.g[k] += on ? c.g : 0.0f;
        sum.b[k] += on ? c.b : 0.0f;
    }
}

}  // namespace mir::sched::detail
