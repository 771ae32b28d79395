// SPDX-License-Identifier: MIT
#pragma once

#include "mir/host/wide_bvh_scene.hpp"
#include "mir/shaft/host/shaft_visibility.hpp"

#include <optional>

namespace mir {

/// A scene traced through wide bounding volume hierarchies, whole blocks by shafts. Owns them,
/// hands out the ray caster and the visibility that read them. The geometry must outlive it. Const
/// use from any thread.
class ShaftScene {
 public:
    /// @throws Error what build_wide_bvh() throws.
    template <Executor E>
    ShaftScene(const WorldGeometry& geometry, E& executor, const WideBvhOptions& options = {})
        : scene_(geometry, executor, options),
          parts_(parts_of(geometry, executor, options)),
          opacity_(geometry.opacity()),
          lanes_(make_triangle_lanes(bvh().triangles())) {}

    /// Builds on the calling thread.
    explicit ShaftScene(const WorldGeometry& geometry) : ShaftScene(geometry, own_thread()) {}

    /// Traces single segments, packets and whole blocks. The scene must outlive it and not be
    /// moved.
    [[nodiscard]] ShaftVisibility visibility() const {
        if (!parts_) return {bvh().view(), lanes_.data(), {}, {}};
        return {bvh().view(), lanes_.data(), {}, {parts_->open.view(), opacity_}};
    }
    /// Closest hits; the scene must outlive it and not be moved.
    [[nodiscard]] WideRayCaster<Space::host> ray_caster() const { return scene_.ray_caster(); }
    /// The hierarchy that shafts go through: that of the opaque triangles.
    [[nodiscard]] const WideBvh& bvh() const { return parts_ ? parts_->opaque : scene_.tree(); }

 private:
    /// Of a scene that is not opaque.
    struct Parts {
        WideBvh opaque;
        WideBvh open;
    };

    static InlineExecutor& own_thread() {
        static InlineExecutor executor;  // without state
        return executor;
    }

    template <Executor E>
    static std::optional<Parts> parts_of(const WorldGeometry& geometry, E& executor,
                                         const WideBvhOptions& options) {
        if (geometry.is_opaque()) return std::nullopt;
        const TrianglesByOpacity parts = triangles_by_opacity(geometry);
        return Parts{build_wide_bvh(geometry, parts.opaque, executor, options),
                     build_wide_bvh(geometry, parts.open, executor, options)};
    }

    WideBvhScene scene_;  ///< all triangles
    std::optional<Parts> parts_;
    OpacityView<Space::host> opacity_;
    std::vector<TriangleLanes> lanes_;
};

}  // namespace mir
