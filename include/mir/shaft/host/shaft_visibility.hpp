// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_rays.hpp"
#include "mir/shaft/host/block_cascade.hpp"
#include "mir/shaft/host/block_veil.hpp"

namespace mir {

/// Answers from wide bounding volume hierarchies in host memory. Segment by segment, for packets,
/// and for blocks of luxels by shafts. Model of BlockVisibility. All faces give the bits of
/// hits_segment() asked of every triangle. Shafts are decided by opaque triangles; those with holes
/// and those that are seen through lie in a hierarchy of their own, which is asked about what the
/// others leave open. Both must outlive it. Thread-safe.
struct ShaftVisibility {
    static constexpr Space space = Space::host;  ///< of the hierarchies

    /// What is known of the luxels of a block.
    struct Block {
        BlockRecords records;         ///< positions and boxes
        InstructionSet instructions;  ///< that visible_block() may use
    };

    WideBvhView<Space::host> bvh;          ///< of the opaque triangles of the scene
    const TriangleLanes* lanes = nullptr;  ///< make_triangle_lanes() of its triangles
    CascadeLimits limits;                  ///< of the searches of shafts; change no bit
    /// Of the other triangles; asked where its mask exists.
    WideBvhVisibility<Space::host> veil{};

    /// True when no triangle hides the points (metres) from each other: !is_hidden(). The same
    /// bit when they change places.
    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const {
        return !is_hidden(bvh, a, b) && (!veil.mask.exists() || veil.visible(a, b));
    }

    /// As PacketVisibility says, bit k being visible(origin, point k). By the widest registers of
    /// the processor.
    [[nodiscard]] std::uint32_t visible_packet(Vec3 origin, const PointPacket& points,
                                               std::uint32_t active) const {
        // Of no opacity: walks are compiled once for both.
        const std::uint32_t open =
            detail::ask_packet(bvh, origin, points, active, OpacityView<Space::host>{});
        return open == 0 || !veil.mask.exists() ? open : veil.visible_packet(origin, points, open);
    }

    /// What visible_block() wants to know of 256 luxels. A copy: nothing of `luxels` is kept.
    /// visible_block() runs by instructions of `set`.
    [[nodiscard]] Block block(const SoaView<const Hit>& luxels, InstructionSet set) const {
        return {BlockRecords(luxels, bvh.reach, sigma_of_reach(bvh.reach)), set};
    }

    /// Not inlined: compiled once for each instruction set, not for every caller.
    [[gnu::noinline]] void visible_block(const Block& b, Vec3 origin, BlockMask& seen) const {
        run_with(b.instructions, [&](auto set) {
            BlockCascade<set.value>(bvh, lanes, b.records, origin).decide(seen, limits);
            if (veil.mask.exists())
                BlockVeil<set.value>(veil.tree, veil.mask, b.records, origin).decide(seen);
        });
    }
};

static_assert(BlockVisibility<ShaftVisibility>);

}  // namespace mir
