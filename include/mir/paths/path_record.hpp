// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_record.hpp"
#include "mir/paths/path_generator.hpp"

namespace mir {

/// The path VPL at x2 of a path. `weight` counts recorded states.
template <class World>
MIR_HD VplRecord record_of(const World& world, const WeightedPath& p, Rgb intensity,
                           double weight) {
    const PathVertex& x = p.path.x(2);
    const bool on_lamp = p.path.edges() == 2;
    VplRecord r;
    r.vpl = {x.position, x.normal, intensity};
    r.origin = {on_lamp ? VplKind::emitter : VplKind::reflective, x.triangle, x.barycentrics, 1.0f};
    r.bounce = static_cast<std::uint8_t>(p.path.bounce());
    r.light_group = p.path.light.light_group;
    r.weight = static_cast<float>(weight);
    r.lobe_share = on_lamp || x.is_through ? 0.0f : world.luxels.surfaces.lobe_share(x.material);
    return r;
}

}  // namespace mir
