// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/finder_ray_caster.hpp"
#include "mir/accel/exact/tree_ray_finder.hpp"
#include "mir/accel/exact/tree_visibility.hpp"

#include <utility>

namespace mir {

/// A scene to trace rays through by way of a tree over its triangles. Owns the tree, hands out the
/// ray caster and the visibility that read it. `Builder` names the Tree and its Options, and has a
/// build(geometry, executor, options). The geometry must outlive it. Const use from any thread.
template <class Builder>
class TreeScene {
 public:
    using Tree = typename Builder::Tree;                        ///< what is built
    using View = decltype(std::declval<const Tree&>().view());  ///< what traversal reads of it
    using Options = typename Builder::Options;                  ///< of the builder

    /// @throws Error what the builder throws.
    template <Executor E>
    TreeScene(const WorldGeometry& geometry, E& executor, const Options& options = {})
        : geometry_(&geometry), tree_(Builder::build(geometry, executor, options)) {}

    /// Builds on the calling thread.
    explicit TreeScene(const WorldGeometry& geometry)
        : geometry_(&geometry), tree_([&] {
              InlineExecutor executor;
              return Builder::build(geometry, executor, {});
          }()) {}

    /// Answers from the tree with the opacity of the scene. Valid while this object and the
    /// geometry stay where they are.
    [[nodiscard]] TreeVisibility<View> visibility() const {
        return {tree_.view(), geometry_->opacity()};
    }
    /// Casts rays at the same surfaces; valid as long.
    [[nodiscard]] FinderRayCaster<TreeRayFinder<View>> ray_caster() const {
        return {*geometry_, tree_.view(), geometry_->alpha_masks()};
    }
    /// The tree itself, for views and statistics.
    [[nodiscard]] const Tree& tree() const { return tree_; }

 private:
    const WorldGeometry* geometry_;
    Tree tree_;
};

}  // namespace mir
