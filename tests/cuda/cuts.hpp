// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_tree.hpp"
#include "mir/cuda/backend.hpp"
#include "mir/scene/world_geometry.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/backend_cuts.hpp"

// What the tests start on the GPU: declared for files with assertions, defined in cuts.cu.

namespace mirtest {

/// The light that the GPU gathers by cuts, with rays by a copied kd-tree. Instantiated for Lambert
/// and CookTorrance, as is the other.
template <mir::Bsdf B>
mir::Image<mir::Rgb> cuts_by_kd_tree_on_gpu(const mir::cuda::Backend& backend,
                                            const CutsAsked<B>& asked, const mir::KdTree& tree);
/// The same with rays by a wide hierarchy that the GPU builds.
template <mir::Bsdf B>
mir::Image<mir::Rgb> cuts_by_wide_bvh_on_gpu(const mir::cuda::Backend& backend,
                                             const CutsAsked<B>& asked,
                                             const mir::WorldGeometry& geometry);

}  // namespace mirtest
