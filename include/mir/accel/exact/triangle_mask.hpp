// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/opacity.hpp"

#include <type_traits>

namespace mir {

/// Says of every point of every triangle that it is there, for every segment. Traversal takes it
/// instead of an AlphaMaskView or an OpacityView where all triangles are opaque; it leaves no
/// instruction behind.
struct Opaque {
    using Masks = Opaque;  ///< what closest hits ask

    /// Itself, there being no holes.
    [[nodiscard]] MIR_HD static constexpr Opaque masks() { return {}; }
    /// Itself, whatever the segment.
    [[nodiscard]] MIR_HD static constexpr Opaque between(Vec3 /*a*/, Vec3 /*b*/) { return {}; }
    /// False: is_solid() need not be asked.
    [[nodiscard]] MIR_HD static constexpr bool exists() { return false; }
    /// True, whatever the point.
    [[nodiscard]] MIR_HD static constexpr bool is_solid(std::uint32_t /*triangle*/,
                                                        Vec2 /*barycentrics*/) {
        return true;
    }
};

/// What segments ask in memory of space `S` unless they are told otherwise. On the host a view that
/// may be empty, which costs a comparison per triangle that is hit; kernels of a device, which
/// would need registers for it, are compiled for one or the other.
template <Space S>
using UsualOpacity = std::conditional_t<S == Space::host, OpacityView<S>, Opaque>;

/// What closest hits ask there.
template <Space S>
using UsualMask = typename UsualOpacity<S>::Masks;

}  // namespace mir
