// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd_build.hpp"
#include "mir/accel/kd_ray_caster.hpp"
#include "mir/accel/kd_tree_visibility.hpp"

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

    [[nodiscard]] KdTreeVisibility<Space::host> visibility() const {
        return {tree_.view(), geometry_->alpha_masks()};
    }
    [[nodiscard]] KdRayCaster<Space::host> ray_caster() const {
        return {*geometry_, tree_.view(), geometry_->alpha_masks()};
    }
    [[nodiscard]] const KdTree& tree() const { return tree_; }

 private:
    const WorldGeometry* geometry_;
    KdTree tree_;
};

}  // namespace mir
