// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

namespace mir {

/// Right-handed orthonormal basis around a unit normal, without branches or square roots.
/// Source: Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017.
struct Frame {
    Vec3 tangent{1, 0, 0};    ///< unit
    Vec3 bitangent{0, 1, 0};  ///< unit, normal x tangent
    Vec3 normal{0, 0, 1};     ///< unit; the z of local coordinates

    /// The frame of the unit vector `n`; a pure function of it.
    MIR_HD static Frame around(Vec3 n) {
        const float sign = n.z >= 0.0f ? 1.0f : -1.0f;
        const float a = -1.0f / (sign + n.z);
        const float b = n.x * n.y * a;
        return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x},
                {b, sign + n.y * n.y * a, -n.y},
                n};
    }

    /// Coordinates along tangent, bitangent and normal to world space; keeps lengths.
    [[nodiscard]] MIR_HD Vec3 to_world(Vec3 local) const {
        return local.x * tangent + local.y * bitangent + local.z * normal;
    }
    /// The inverse of to_world().
    [[nodiscard]] MIR_HD Vec3 to_local(Vec3 world) const {
        return {glm::dot(world, tangent), glm::dot(world, bitangent), glm::dot(world, normal)};
    }
};

}  // namespace mir
