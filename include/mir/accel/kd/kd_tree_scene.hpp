// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_build.hpp"
#include "mir/accel/kd/kd_ray_caster.hpp"
#include "mir/accel/kd/kd_tree_visibility.hpp"

namespace mir {

/// A scene to trace rays through by way of a kd-tree: owns the tree, hands out the ray caster and
/// the visibility that read it. The geometry must outlive it. Const use from any thread.
class KdTreeScene {
 public:
    /// @throws Error what KdTree throws.
    template <Executor E>
    KdTreeScene(const WorldGeometry& geometry, E& executor, const KdTreeOptions& options = {})
        : geometry_(&geometry), tree_(geometry, options, executor) {}

    /// Builds on the calling thread.
    explicit KdTreeScene(const WorldGeometry& geometry)
        : geometry_(&geometry), tree_([&] {
              InlineExecutor executor;
              return KdTree(geometry, {}, executor);
          }()) {}

    /// Answers from the tree with the masks of the scene. Valid while this object and the geometry
    /// stay where they are.
    [[nodiscard]] KdTreeVisibility<Space::host> visibility() const {
        return {tree_.view(), geometry_->alpha_masks()};
    }
    /// Casts rays at the same surfaces; valid as long.
    [[nodiscard]] KdRayCaster<Space::host> ray_caster() const {
        return {*geometry_, tree_.view(), geometry_->alpha_masks()};
    }
    /// The tree itself, for views and statistics.
    [[nodiscard]] const KdTree& tree() const { return tree_; }

 private:
    const WorldGeometry* geometry_;
    KdTree tree_;
};

}  // namespace mir
