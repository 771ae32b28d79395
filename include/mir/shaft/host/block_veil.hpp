// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/host/block_records.hpp"
#include "mir/shaft/host/lane_search.hpp"

namespace mir {

/// Which of the 256 luxels of a block see one VPL past triangles that are not opaque. These stop
/// segments one by one, so that no shaft can be covered; most shafts meet none of them. Bits are
/// those of is_hidden(). Made for one pair, on the host.
template <InstructionSet Set>
class BlockVeil {
 public:
    /// `veil` is a hierarchy of such triangles. All must outlive this.
    BlockVeil(const WideBvhView<Space::host>& veil, const OpacityView<Space::host>& opacity,
              const BlockRecords& block, Vec3 apex)
        : veil_(veil),
          opacity_(opacity),
          block_(block),
          apex_(apex),
          is_proved_(is_proved_scale(veil.reach) && within_reach(apex, veil.reach)) {}

    /// Clears the bits of luxels that do not see the VPL.
    void decide(BlockMask& mask) const {
        if (!mask.any() || !may_meet(block_.all)) return;
        for (std::uint32_t g = 0; g < BlockMask::packets; ++g)
            if (mask.packet[g] != 0) mask.packet[g] = seen(g, mask.packet[g]);
    }

 private:
    /// Nodes that the shaft of a block may visit to find that it meets no leaf.
    static constexpr std::uint32_t most_nodes = 16;

    /// False when the shaft of a cluster meets no triangle.
    [[nodiscard]] bool may_meet(const BlockRecords::Cluster& cluster) const {
        if (!is_proved_ || !cluster.within) return true;
        const SlotShaft shaft(make_shaft(cluster.record, apex_, block_.sigma));
        WaitingNodes waiting;
        waiting.push_root(veil_.reach);
        for (std::uint32_t i = 0; i < most_nodes && waiting.size() != 0; ++i) {
            const WideNode& node = veil_.nodes[waiting.last()];
            waiting.pop();
            const std::uint32_t met = shaft.template met<Set>(node);
            if ((met & detail::leaf_slots<Set>(node)) != 0) return true;
            for (std::uint32_t inner = met & detail::inner_slots<Set>(node); inner != 0;)
                waiting.push(node, detail::pop_lowest(inner));
        }
        return waiting.size() != 0;
    }

    /// Lanes of `open`, of packet `g`, that see the VPL.
    [[nodiscard]] std::uint32_t seen(std::uint32_t g, std::uint32_t open) const {
        const BlockRecords::Cluster& packet = block_.packet[g];
        if (!is_proved_ || !packet.within)
            return visible_in_packet<Set>(veil_, apex_, block_.points[g], open, opacity_);
        const SlotShaft shaft(make_shaft(packet.record, apex_, block_.sigma));
        detail::WidePacketWalk<Set, SlotShaft> walk(veil_, shaft, apex_, block_.points + g, open,
                                                    &opacity_);
        return walk.run();
    }

    const WideBvhView<Space::host>& veil_;
    const OpacityView<Space::host>& opacity_;
    const BlockRecords& block_;
    Vec3 apex_;
    bool is_proved_;  ///< the shafts' proof holds for the VPL
};

}  // namespace mir
