// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_bvh_visibility.hpp"
#include "mir/accel/wide/wide_ray_caster.hpp"
#include "mir/host/wide_build.hpp"

namespace mir {

/// A scene to trace rays through by way of a wide bounding volume hierarchy: owns it, hands out the
/// ray caster and the visibility that read it. The geometry must outlive it. Const use from any
/// thread.
class WideBvhScene {
 public:
    /// @throws Error what build_wide_bvh() throws.
    template <Executor E>
    WideBvhScene(const WorldGeometry& geometry, E& executor, const WideBvhOptions& options = {})
        : geometry_(&geometry), bvh_(build_wide_bvh(geometry, executor, options)) {}

    /// Builds on the calling thread.
    explicit WideBvhScene(const WorldGeometry& geometry)
        : geometry_(&geometry), bvh_([&] {
              InlineExecutor executor;
              return build_wide_bvh(geometry, executor);
          }()) {}

    /// Asks single segments and packets; the scene must outlive it and not be moved.
    [[nodiscard]] WideBvhVisibility<Space::host> visibility() const {
        return {bvh_.view(), geometry_->alpha_masks()};
    }
    /// Closest hits; the scene must outlive it and not be moved.
    [[nodiscard]] WideRayCaster<Space::host> ray_caster() const {
        return {*geometry_, bvh_.view(), geometry_->alpha_masks()};
    }
    /// The hierarchy that both read.
    [[nodiscard]] const WideBvh& bvh() const { return bvh_; }

 private:
    const WorldGeometry* geometry_;
    WideBvh bvh_;
};

}  // namespace mir
