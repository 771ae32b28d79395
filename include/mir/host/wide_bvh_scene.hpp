// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/tree_scene.hpp"
#include "mir/accel/wide/wide_rays.hpp"
#include "mir/host/wide_build.hpp"

namespace mir {

/// How a TreeScene makes a wide bounding volume hierarchy.
struct WideBvhBuilder {
    using Tree = WideBvh;            ///< of all triangles
    using Options = WideBvhOptions;  ///< of its construction

    /// @throws Error what build_wide_bvh() throws.
    template <Executor E>
    [[nodiscard]] static Tree build(const WorldGeometry& geometry, E& executor,
                                    const Options& options) {
        return build_wide_bvh(geometry, executor, options);
    }
};

/// A scene to trace rays through by way of a wide bounding volume hierarchy.
using WideBvhScene = TreeScene<WideBvhBuilder>;

}  // namespace mir
