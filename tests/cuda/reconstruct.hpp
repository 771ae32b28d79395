// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/shading.hpp"
#include "mir/cuda/backend.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/data/image.hpp"
#include "mir/data/visibility_matrix.hpp"
#include "mir/data/vpl_list.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/brute_force_view.hpp"

// What the tests start on the GPU: declared for files with assertions, defined in reconstruct.cu.

namespace mirtest {

/// The paper's names for the schedulers over a backend.
enum class Algorithm { os, rc, rcvp };
inline constexpr Algorithm algorithms[] = {Algorithm::os, Algorithm::rc, Algorithm::rcvp};

template <class F>
using LuxelsFor = mir::BlockedGBuffer<decltype(F::Surface::bsdf)>;

/// An image of `algorithm` over the GPU. OS traces on the host, the others on the GPU. Instantiated
/// for VplShading of Lambert and CookTorrance and for RemovedByBound of CookTorrance.
template <mir::Shading F>
mir::Image<mir::Rgb> reconstruct_on(const mir::cuda::Backend& backend, Algorithm algorithm,
                                    const LuxelsFor<F>& gbuffer,
                                    mir::VplSpan<mir::Space::host> vpls,
                                    BruteForceView<mir::Space::host> visibility, F shading);

/// The same from known visibility. Instantiated for VplShading<Lambert>.
template <mir::Shading F>
mir::Image<mir::Rgb> reshade_on(const mir::cuda::Backend& backend, Algorithm algorithm,
                                const LuxelsFor<F>& gbuffer, mir::VplSpan<mir::Space::host> vpls,
                                const mir::VisibilityMatrix& matrix, F shading);

/// RCVP from luxels in pinned memory.
mir::Image<mir::Rgb> reconstruct_pinned_on(
    const mir::cuda::Backend& backend,
    const mir::BlockedGBuffer<mir::Lambert::Params, mir::cuda::PinnedAllocator<std::uint32_t>>&
        gbuffer,
    mir::VplSpan<mir::Space::host> vpls, BruteForceView<mir::Space::host> visibility,
    mir::VplShading<mir::Lambert> shading);

}  // namespace mirtest
