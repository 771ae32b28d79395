// SPDX-License-Identifier: MIT
#include "runtime/backend_structures.hpp"

namespace mir {
namespace {

/// Luxels times VPLs from which a kd-tree is worth building. Single rays walk it faster, but the
/// host takes time to build it (docs/decisions/031). Bits are the same.
constexpr double kd_tree_pays = 13e9;

constexpr BackendStructures both{"kdtree+shafts", true, true};
constexpr BackendStructures hierarchy{"bvh", false, true};

}  // namespace

BackendStructures structures_of(bool is_opaque, const RenderSettings& settings) {
    if (!is_opaque) return hierarchy;
    switch (settings.acceleration) {
        case Acceleration::kd_tree:
            return tree_alone;
        case Acceleration::bvh:
            return hierarchy;
        case Acceleration::automatic:
        case Acceleration::embree:  // refused before
            break;
    }
    return pairs(settings) < kd_tree_pays ? hierarchy : both;
}

}  // namespace mir
