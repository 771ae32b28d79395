// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"

#include <cmath>

namespace mir::validation::detail {

/// Calls visit(wi, solid_angle) for the cells of a grid over the sphere. Its poles are `axis` and
/// -axis. Rings widen geometrically from 1e-5 rad on, so that a lobe of any width around `axis` is
/// resolved; `rings` x `sectors` cells whose solid angles add up to 4 pi less the innermost cap.
template <class Visit>
void for_each_direction_around(Vec3 axis, int rings, int sectors, const Visit& visit) {
    const Frame frame = mir::Frame::around(axis);
    const double half_turn = 3.14159265358979323846;
    const double innermost = 1e-5;
    const double growth = std::log(half_turn / innermost) / rings;
    double theta = innermost;
    for (int r = 0; r < rings; ++r) {
        const double next = r + 1 == rings ? half_turn : innermost * std::exp(growth * (r + 1));
        const double solid_angle = (std::cos(theta) - std::cos(next)) * 2.0 * half_turn / sectors;
        const double middle = std::acos(0.5 * (std::cos(theta) + std::cos(next)));
        for (int s = 0; s < sectors; ++s) {
            const double phi = 2.0 * half_turn * (s + 0.5) / sectors;
            const Vec3 local(static_cast<float>(std::sin(middle) * std::cos(phi)),
                             static_cast<float>(std::sin(middle) * std::sin(phi)),
                             static_cast<float>(std::cos(middle)));
            visit(frame.to_world(local), solid_angle);
        }
        theta = next;
    }
}

}  // namespace mir::validation::detail
