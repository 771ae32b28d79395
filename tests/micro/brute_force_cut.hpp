// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_traverse.hpp"
#include "mir/micro/surfel_tree.hpp"

namespace mirtest {

/// Nearest of all nodes at which a walk has to end, whatever the spheres above them: inner nodes of
/// which is_end(index) is true, and discs.
template <class IsEnd>
mir::SurfelHit brute_force_cut(const mir::SurfelTree& tree, const mir::SurfelRay& ray,
                               const IsEnd& is_end) {
    mir::SurfelHit hit;
    for (std::uint32_t i = 0; i < tree.nodes().size();) {
        const mir::SurfelNode& node = tree.nodes()[i];
        const bool ends = node.is_leaf() || is_end(i);
        if (ends) mir::detail::meet_disc(tree.view(), node, i, ray, hit);
        i += ends ? 2 * node.count - 1 : 1;
    }
    return hit;
}

/// For an approximate ray.
inline mir::SurfelHit brute_force_cut(const mir::SurfelTree& tree, const mir::SurfelRay& ray) {
    const float sine2 = mir::cap_sine_squared(ray.solid_angle);
    return brute_force_cut(tree, ray, [&](std::uint32_t node) {
        return mir::detail::stops_at(tree.nodes()[node], ray.normal,
                                     tree.nodes()[node].centre - ray.origin, sine2);
    });
}

}  // namespace mirtest
