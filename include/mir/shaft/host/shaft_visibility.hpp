// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/packet_visibility.hpp"
#include "mir/shaft/host/block_cascade.hpp"

namespace mir {

/// Answers from a wide bounding volume hierarchy in host memory. Segment by segment, for packets,
/// and for blocks of luxels by shafts. Model of BlockVisibility. All faces give the bits of
/// hits_segment() asked of every triangle. A shaft is decided by opaque triangles, so where some
/// are not, blocks are asked by packets. The hierarchy must outlive it. Thread-safe.
struct ShaftVisibility {
    static constexpr Space space = Space::host;  ///< of the hierarchy

    /// What is known of the luxels of a block.
    struct Block {
        BlockRecords records;         ///< positions and boxes
        InstructionSet instructions;  ///< that visible_block() may use
    };

    WideBvhView<Space::host> bvh;          ///< of the scene
    const TriangleLanes* lanes = nullptr;  ///< make_triangle_lanes() of its triangles; not read
                                           ///< where some are not opaque
    CascadeLimits limits;                  ///< of the searches of shafts; change no bit
    OpacityView<Space::host> opacity{};    ///< which triangles stop a segment

    /// True when no triangle hides the points (metres) from each other: !is_hidden(). The same
    /// bit when they change places.
    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const { return !is_hidden(bvh, a, b, opacity); }

    /// As PacketVisibility says, bit k being visible(origin, point k). By the widest registers of
    /// the processor.
    [[nodiscard]] std::uint32_t visible_packet(Vec3 origin, const PointPacket& points,
                                               std::uint32_t active) const {
        return detail::ask_packet(bvh, origin, points, active, opacity);
    }

    /// What visible_block() wants to know of 256 luxels. A copy: nothing of `luxels` is kept.
    /// visible_block() runs by instructions of `set`.
    [[nodiscard]] Block block(const SoaView<const Hit>& luxels, InstructionSet set) const {
        return {BlockRecords(luxels, bvh.reach, sigma_of_reach(bvh.reach)), set};
    }

    /// Not inlined: compiled once for each instruction set, not for every caller.
    [[gnu::noinline]] void visible_block(const Block& b, Vec3 origin, BlockMask& seen) const {
        run_with(b.instructions, [&](auto set) {
            if (opacity.exists())
                ask_packets(b, origin, seen);
            else
                BlockCascade<set.value>(bvh, lanes, b.records, origin).decide(seen, limits);
        });
    }

 private:
    void ask_packets(const Block& b, Vec3 origin, BlockMask& seen) const {
        for (std::uint32_t g = 0; g < BlockMask::packets; ++g)
            if (seen.packet[g] != 0)
                seen.packet[g] = visible_packet(origin, b.records.points[g], seen.packet[g]);
    }
};

static_assert(BlockVisibility<ShaftVisibility>);

}  // namespace mir
