// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/packet_visibility.hpp"
#include "mir/accel/wide/wide_packet.hpp"
#include "mir/accel/wide/wide_traverse.hpp"
#include "mir/concepts/visibility.hpp"

namespace mir {

/// Answers from a wide bounding volume hierarchy in memory of space `S`: a value that may be passed
/// to a kernel. Model of Visibility, on the host of PacketVisibility too. Both faces give the bits
/// of hits_segment() asked of every triangle, on the host and on the device. `M` says which points
/// of triangles are there, an Opaque or an AlphaMaskView. What it reads must outlive it.
/// Thread-safe.
template <Space S, class M = UsualMask<S>>
struct WideBvhVisibility {
    static constexpr Space space = S;  ///< of the hierarchy

    WideBvhView<S> bvh;  ///< of the scene
    M mask{};            ///< which points of triangles are there

    /// True when no triangle hides the points (metres) from each other: !is_hidden(). The same
    /// bit when they change places.
    [[nodiscard]] MIR_HD bool visible(Vec3 a, Vec3 b) const { return !is_hidden(bvh, a, b, mask); }

    /// As PacketVisibility says, bit k being visible(origin, point k); by the widest registers of
    /// the processor.
    [[nodiscard]] std::uint32_t visible_packet(Vec3 origin, const PointPacket& points,
                                               std::uint32_t active) const
        requires(S == Space::host) {
        if constexpr (std::is_same_v<M, Opaque>)
            return detail::ask_packet(bvh, origin, points, active);
        else
            return detail::ask_packet(bvh, origin, points, active, mask);
    }
};

static_assert(PacketVisibility<WideBvhVisibility<Space::host>>);
static_assert(Visibility<WideBvhVisibility<Space::device>>);

}  // namespace mir
