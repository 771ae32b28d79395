// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/tree_scene.hpp"
#include "mir/accel/kd/kd_build.hpp"
#include "mir/accel/kd/kd_rays.hpp"

namespace mir {

/// How a TreeScene makes a kd-tree.
struct KdTreeBuilder {
    using Tree = KdTree;            ///< of all triangles
    using Options = KdTreeOptions;  ///< of its construction

    /// @throws Error what KdTree throws.
    template <Executor E>
    [[nodiscard]] static Tree build(const WorldGeometry& geometry, E& executor,
                                    const Options& options) {
        return {geometry, options, executor};
    }
};

/// A scene to trace rays through by way of a kd-tree.
using KdTreeScene = TreeScene<KdTreeBuilder>;

}  // namespace mir
