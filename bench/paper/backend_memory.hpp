// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_rays.hpp"
#include "mir/accel/wide/wide_rays.hpp"
#include "mir/resident/backend_wide_bvh.hpp"
#include "mir/resident/quantised_bvh.hpp"
#include "mir/resident/trace_primary_hits.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "mir/resident/uploaded_trees.hpp"
#include "mir/shaft/device/cluster_visibility.hpp"
#include "paper_scene.hpp"

namespace mirpaper {

/// A scene in a backend's memory.
template <mir::Backend B>
class SceneOnBackend {
 public:
    SceneOnBackend(const B& backend, const PaperScene& scene)
        : queue_(backend.queue()),
          tree_(backend, queue_, scene.tree()),
          geometry_(backend, queue_, scene.geometry()),
          bvh_(backend, queue_, scene.geometry(), geometry_.view(), scene.wide_options()),
          short_(backend, queue_, bvh_.view(), bvh_.node_count()),
          sigma_(scene.sigma()),
          surfaces_(backend, queue_, scene.surfaces()),
          rays_(scene.camera_rays().luxel_rays()) {
        queue_.record().sync();
    }

    /// Valid as long as this object.
    [[nodiscard]] mir::KdTreeVisibility<B::space> visibility() const { return {tree_.view()}; }

    [[nodiscard]] mir::WideBvhVisibility<B::space> wide_visibility() const { return {bvh_.view()}; }
    /// Shafts that leave segments to `rays`.
    template <mir::Visibility V>
    [[nodiscard]] mir::ClusterVisibility<V> with_shafts(const V& rays) const {
        return {short_.view(), sigma_, rays};
    }

    /// Starts to trace all luxels on `queue`.
    void trace(typename B::Queue& queue, mir::BackendGBuffer<B, Bsdf::Params>& luxels) const {
        const mir::KdRayCaster<B::space> caster(geometry_.view(), tree_.view());
        mir::trace_primary_hits(queue, luxels, 0, rays_, mir::LuxelTracer{caster, surfaces_.view()},
                                {});
    }

 private:
    typename B::Queue queue_;
    mir::UploadedKdTree<B> tree_;
    mir::UploadedGeometry<B> geometry_;
    mir::BackendWideBvh<B> bvh_;
    mir::QuantisedBvh<B> short_;
    float sigma_;
    mir::UploadedSurfaces<B, Bsdf> surfaces_;
    mir::LuxelRays rays_;
};

}  // namespace mirpaper
