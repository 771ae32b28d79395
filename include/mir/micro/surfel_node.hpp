// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <cstdint>

namespace mir {

/// One node of a hierarchy of discs, 48 bytes. It has a sphere and a cone around everything below
/// it. A leaf is one disc: then the sphere is the disc's, and the axis its normal. Nodes lie in the
/// order of a walk that visits the left child first, so the left child follows its parent, and n
/// discs make 2 n - 1 nodes. A trivially copyable value, the same on host and device.
struct alignas(16) SurfelNode {
    Vec3 centre{0};          ///< of the sphere, metres
    float radius = 0.0f;     ///< of the sphere, metres
    Vec3 axis{0, 0, 1};      ///< unit, of the cone around the normals of the discs' fronts
    float cos_angle = 1.0f;  ///< of the cone's half-angle, -1 to 1
    /// How far the discs reach along the axis, to either side, metres. Counted from the centre: a
    /// flat piece of a wall has its sphere's radius across and next to nothing along.
    float thickness = 0.0f;
    std::uint32_t right = 0;  ///< index of the right child; 0 in leaves
    std::uint32_t first = 0;  ///< first disc below, in the order of the tree
    std::uint32_t count = 0;  ///< discs below

    /// True when the node is one disc, that of index `first`.
    [[nodiscard]] MIR_HD bool is_leaf() const { return right == 0; }
};
static_assert(sizeof(SurfelNode) == 48);

}  // namespace mir
