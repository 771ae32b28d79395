// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_traverse.hpp"
#include "mir/micro/surfel_tree.hpp"

namespace mirtest {

/// Nearest of all nodes at which an approximate ray has to end, whatever the spheres above them.
inline mir::SurfelHit brute_force_cut(const mir::SurfelTree& tree, const mir::SurfelRay& ray) {
    mir::SurfelHit hit;
    const float sine2 = mir::cap_sine_squared(ray.solid_angle);
    for (std::uint32_t i = 0; i < tree.nodes().size();) {
        const mir::SurfelNode& node = tree.nodes()[i];
        const bool ends = node.is_leaf() || mir::detail::stops_at(tree.view(), i, ray, sine2);
        if (ends) mir::detail::meet_disc(tree.view(), i, ray, hit);
        i += ends ? 2 * node.count - 1 : 1;
    }
    return hit;
}

}  // namespace mirtest
