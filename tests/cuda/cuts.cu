// SPDX-License-Identifier: MIT
#include "cuda/cuts.hpp"
#include "mir/cuda/backend.cuh"
#include "mir/cuda/sort.cuh"
#include "mir/resident/backend_wide_bvh.hpp"
#include "mir/resident/ray_structures.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "mir/resident/uploaded_trees.hpp"

namespace mirtest {

using mir::cuda::Backend;
using Picture = mir::Image<mir::Rgb>;

template <mir::Bsdf B>
Picture cuts_by_kd_tree_on_gpu(const Backend& backend, const CutsAsked<B>& asked,
                               const mir::KdTree& tree) {
    auto queue = backend.queue();
    const mir::UploadedKdTree<Backend> there(backend, queue, tree);
    queue.sync();
    return cuts_on(backend, asked, mir::KdRays<Backend::space>{there.view()}.sight());
}

template <mir::Bsdf B>
Picture cuts_by_wide_bvh_on_gpu(const Backend& backend, const CutsAsked<B>& asked,
                                const mir::WorldGeometry& geometry) {
    auto queue = backend.queue();
    const mir::UploadedGeometry<Backend> there(backend, queue, geometry);
    const mir::BackendWideBvh<Backend> bvh(backend, queue, geometry, there.view());
    return cuts_on(backend, asked, mir::WideRays<Backend::space>{bvh.view()}.sight());
}

using mir::CookTorrance;
using mir::Lambert;

template Picture cuts_by_kd_tree_on_gpu(const Backend&, const CutsAsked<Lambert>&,
                                        const mir::KdTree&);
template Picture cuts_by_kd_tree_on_gpu(const Backend&, const CutsAsked<CookTorrance>&,
                                        const mir::KdTree&);
template Picture cuts_by_wide_bvh_on_gpu(const Backend&, const CutsAsked<Lambert>&,
                                         const mir::WorldGeometry&);
template Picture cuts_by_wide_bvh_on_gpu(const Backend&, const CutsAsked<CookTorrance>&,
                                         const mir::WorldGeometry&);

}  // namespace mirtest
