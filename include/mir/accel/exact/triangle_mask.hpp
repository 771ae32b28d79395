// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/alpha_mask.hpp"

#include <type_traits>

namespace mir {

/// Says of every point of every triangle that it is there. Traversal takes it instead of an
/// AlphaMaskView where no triangle is masked; it leaves no instruction behind.
struct Opaque {
    /// False: is_solid() need not be asked.
    [[nodiscard]] MIR_HD static constexpr bool exists() { return false; }
    /// True, whatever the point.
    [[nodiscard]] MIR_HD static constexpr bool is_solid(std::uint32_t /*triangle*/,
                                                        Vec2 /*barycentrics*/) {
        return true;
    }
};

/// What engines in memory of space `S` ask unless they are told otherwise. On the host a view that
/// may be empty, which costs a comparison per triangle that is hit; kernels of a device, which
/// would need registers for it, are compiled for one or the other.
template <Space S>
using UsualMask = std::conditional_t<S == Space::host, AlphaMaskView<S>, Opaque>;

}  // namespace mir
