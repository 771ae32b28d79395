// SPDX-License-Identifier: MIT
#pragma once

// Members of BackendFrame that bring the scene to the backend and build there.

#include "runtime/backend_frame.hpp"

namespace mir {

template <Backend M, Bsdf B>
BackendFrame<M, B>::BackendFrame(RenderJob& job, const M& machine, MakeTree make_tree,
                                 const BackendFrameOptions& options)
    : RenderFrame(job, {sizeof(Hit) + sizeof(Surface<Params>), false}),
      job_(job),
      machine_(machine),
      make_tree_(std::move(make_tree)),
      options_(job.geometry.is_opaque() ? options : options.see_through()),
      sigma_(static_cast<float>(sigma_of(magnitude_of(job.geometry.bounds())))),
      queue_(machine.queue()),
      geometry_there_(machine, queue_, job.geometry),
      lights_(machine, queue_, job.lights),
      surfaces_(machine, queue_, std::get<SurfaceTable<B>>(job.surfaces)),
      masks_(machine, queue_, job.geometry.masks()),
      see_through_(machine, queue_, job.geometry.see_through()) {
    queue_.record().sync();
    if (options_.kd_tree) {
        tree_.emplace(machine, queue_, host_tree());
        queue_.record().sync();
    }
    if (options_.needs_bvh()) build_bvh();
}

template <Backend M, Bsdf B>
void BackendFrame<M, B>::build_bvh() {
    const auto stage = job_.clock.measure(&StageSeconds::build);
    bvh_.emplace(machine_, queue_, job_.geometry, geometry_there_.view());
    if (!options_.shafts) return;
    if (job_.geometry.is_opaque())
        short_bvh_.emplace(machine_, queue_, bvh_->view(), bvh_->node_count());
    else
        build_parts();
    queue_.record().sync();
}

template <Backend M, Bsdf B>
void BackendFrame<M, B>::build_parts() {
    const TrianglesByOpacity parts = triangles_by_opacity(job_.geometry);
    const UploadedTriangles<M> opaque(machine_, queue_, parts.opaque);
    const UploadedTriangles<M> open(machine_, queue_, parts.open);
    opaque_bvh_.emplace(machine_, queue_, job_.geometry, geometry_there_.view(), opaque.view());
    open_bvh_.emplace(machine_, queue_, job_.geometry, geometry_there_.view(), open.view());
    short_bvh_.emplace(machine_, queue_, opaque_bvh_->view(), opaque_bvh_->node_count());
    short_open_bvh_.emplace(machine_, queue_, open_bvh_->view(), open_bvh_->node_count());
}

template <Backend M, Bsdf B>
const KdTree& BackendFrame<M, B>::host_tree() {
    if (!host_tree_) {
        const auto stage = job_.clock.measure(&StageSeconds::build);
        host_tree_ = make_tree_();
    }
    return *host_tree_;
}

template <Backend M, Bsdf B>
const AnyEngine& BackendFrame<M, B>::rays() {
    /// An engine by the tree of the host.
    struct TreeOfHost {
        const KdTree& tree;
        const WorldGeometry& geometry;

        [[nodiscard]] KdTreeVisibility<Space::host> visibility() const {
            return {tree.view(), geometry.opacity()};
        }
        [[nodiscard]] KdRayCaster<Space::host> ray_caster() const {
            return {geometry, tree.view(), geometry.alpha_masks()};
        }
    };
    if (!rays_) rays_.emplace(TreeOfHost{host_tree(), job_.geometry});
    return *rays_;
}

}  // namespace mir
