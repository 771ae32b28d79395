// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

namespace mirpy {

/// True where a target lies before the surface of a point, which is lifted. `front`, if there is
/// one, is the side of the target that counts. Zero normals face nothing.
MIR_HD inline bool faces_target(mir::Vec3 place, mir::Vec3 normal, mir::Vec3 target,
                                const mir::Vec3* front) {
    const mir::Vec3 d = target - place;
    return (front == nullptr || glm::dot(d, *front) < 0.0f) && glm::dot(d, normal) > 0.0f;
}

}  // namespace mirpy
