// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/packet_visibility.hpp"
#include "mir/accel/exact/triangle_mask.hpp"
#include "mir/concepts/visibility.hpp"

namespace mir {

/// Answers from a tree over triangles: a value that may be passed to a kernel. Model of Visibility,
/// on the host of PacketVisibility too. Both faces give the bits of hits_segment() asked of every
/// triangle, on the host and on the device. `View` is what traversal reads of the tree: it has
/// is_hidden(), and on the host visible_in_packet(). `M` says which triangles stop a segment, an
/// Opaque or an OpacityView. What it reads must outlive it. Thread-safe.
template <class View, class M = UsualOpacity<View::space>>
struct TreeVisibility {
    static constexpr Space space = View::space;  ///< of the tree

    View tree;  ///< of the scene
    M mask{};   ///< which triangles stop a segment

    /// True when no triangle hides the points (metres) from each other: !is_hidden(). The same
    /// bit when they change places.
    [[nodiscard]] MIR_HD bool visible(Vec3 a, Vec3 b) const { return !is_hidden(tree, a, b, mask); }

    /// As PacketVisibility says, bit k being visible(origin, point k). By the widest registers of
    /// the processor.
    [[nodiscard]] std::uint32_t visible_packet(Vec3 origin, const PointPacket& points,
                                               std::uint32_t active) const
        requires(View::space == Space::host) {
        if constexpr (std::is_same_v<M, Opaque>)
            return detail::ask_packet(tree, origin, points, active);
        else
            return detail::ask_packet(tree, origin, points, active, mask);
    }
};

}  // namespace mir
