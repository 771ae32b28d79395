// SPDX-License-Identifier: MIT
#pragma once

#include "mir/host/wide_bvh_scene.hpp"
#include "mir/shaft/host/shaft_visibility.hpp"

namespace mir {

/// A scene traced through a wide bounding volume hierarchy, whole blocks by shafts. Owns the
/// hierarchy, hands out the ray caster and the visibility that read it. The geometry must outlive
/// it. Const use from any thread.
class ShaftScene {
 public:
    /// @throws Error what build_wide_bvh() throws.
    template <Executor E>
    ShaftScene(const WorldGeometry& geometry, E& executor, const WideBvhOptions& options = {})
        : scene_(geometry, executor, options), lanes_(lanes_of(bvh(), geometry)) {}

    /// Builds on the calling thread.
    explicit ShaftScene(const WorldGeometry& geometry)
        : scene_(geometry), lanes_(lanes_of(bvh(), geometry)) {}

    /// Traces single segments, packets and whole blocks. The scene must outlive it and not be
    /// moved.
    [[nodiscard]] ShaftVisibility visibility() const {
        return {bvh().view(), lanes_.data(), {}, scene_.visibility().mask};
    }
    /// Closest hits; the scene must outlive it and not be moved.
    [[nodiscard]] WideRayCaster<Space::host> ray_caster() const { return scene_.ray_caster(); }
    /// The hierarchy that both read.
    [[nodiscard]] const WideBvh& bvh() const { return scene_.tree(); }

 private:
    /// None where some triangle is not opaque: no shaft is traced then.
    static std::vector<TriangleLanes> lanes_of(const WideBvh& bvh, const WorldGeometry& geometry) {
        if (!geometry.is_opaque()) return {};
        return make_triangle_lanes(bvh.triangles());
    }

    WideBvhScene scene_;
    std::vector<TriangleLanes> lanes_;
};

}  // namespace mir
