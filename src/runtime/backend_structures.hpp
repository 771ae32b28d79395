// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/settings.hpp"

namespace mir {

/// What a BackendFrame is to build, and its name in statistics.
struct BackendStructures {
    const char* name;
    bool kd_tree;  ///< BackendFrameOptions::kd_tree
    bool shafts;   ///< BackendFrameOptions::shafts
};

/// Of renders whose rays are traced on the host.
inline constexpr BackendStructures tree_alone{"kdtree", true, false};

/// As settings want it, or by what pays.
[[nodiscard]] BackendStructures structures_of(bool is_opaque, const RenderSettings& settings);

}  // namespace mir
