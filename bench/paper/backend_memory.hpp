// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd_ray_finder.hpp"
#include "mir/accel/kd_ropes.hpp"
#include "mir/resident/trace_primary_hits.hpp"
#include "mir/resident/uploaded_geometry.hpp"
#include "mir/resident/uploaded_kd_tree.hpp"
#include "mir/resident/uploaded_surfaces.hpp"
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
          surfaces_(backend, queue_, scene.surfaces()),
          rays_(scene.camera_rays().luxel_rays()) {
        queue_.record().sync();
    }

    /// Valid as long as this object.
    [[nodiscard]] mir::KdTreeVisibility<B::space> visibility() const { return {tree_.view()}; }

    /// Starts to trace all luxels on `queue`.
    void trace(typename B::Queue& queue, mir::BackendGBuffer<B, Bsdf::Params>& luxels) const {
        mir::trace_primary_hits<B, Bsdf>(queue, luxels, 0, rays_,
                                         mir::KdRayFinder<B::space>{tree_.view()}, geometry_.view(),
                                         surfaces_.view());
    }

 private:
    typename B::Queue queue_;
    mir::UploadedKdTree<B> tree_;
    mir::UploadedGeometry<B> geometry_;
    mir::UploadedSurfaces<B, Bsdf> surfaces_;
    mir::LuxelRays rays_;
};

/// Answers a kd-tree along ropes. Model of Visibility.
template <mir::Space S>
struct RopesVisibility {
    static constexpr mir::Space space = S;

    mir::KdRopesView<S> ropes;

    [[nodiscard]] MIR_HD bool visible(mir::Vec3 a, mir::Vec3 b) const {
        return !mir::is_hidden(ropes, a, b);
    }
};

/// The ropes of a kd-tree in a backend's memory, beside the tree itself, which must outlive them.
template <mir::Backend B>
class RopesOnBackend {
 public:
    RopesOnBackend(const B& backend, const mir::KdTree& tree,
                   const mir::KdTreeView<B::space>& uploaded)
        : RopesOnBackend(backend, mir::KdRopes(tree.nodes()), uploaded) {}

    [[nodiscard]] RopesVisibility<B::space> visibility() const {
        return {{nodes_.data(), leaves_.data(), tree_.references, tree_.triangles, tree_.reach}};
    }

 private:
    RopesOnBackend(const B& backend, const mir::KdRopes& ropes,
                   const mir::KdTreeView<B::space>& uploaded)
        : queue_(backend.queue()),
          nodes_(backend, queue_, ropes.nodes()),
          leaves_(backend, queue_, ropes.leaves()),
          tree_(uploaded) {
        queue_.record().sync();
    }

    typename B::Queue queue_;
    mir::UploadedArray<B, mir::KdNode> nodes_;
    mir::UploadedArray<B, mir::KdRopeLeaf> leaves_;
    mir::KdTreeView<B::space> tree_;
};

}  // namespace mirpaper
