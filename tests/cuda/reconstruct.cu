// SPDX-License-Identifier: MIT
#include "cuda/device_rows.hpp"
#include "cuda/reconstruct.hpp"
#include "mir/cuda/backend.cuh"
#include "mir/reshade.hpp"
#include "mir/sched/reconstruct.hpp"
#include "mir/sched/reconstruct_visibility_parallel.hpp"
#include "mir/sched/shading_only.hpp"
#include "mir/shading/cook_torrance.hpp"

namespace mirtest {

namespace {

using mir::cuda::Backend;
using HostSight = BruteForceView<mir::Space::host>;

}  // namespace

template <mir::Shading F>
mir::Image<mir::Rgb> reconstruct_on(const Backend& backend, Algorithm algorithm,
                                    const LuxelsFor<F>& gbuffer,
                                    mir::VplSpan<mir::Space::host> vpls, HostSight visibility,
                                    F shading) {
    mir::InlineExecutor executor;
    if (algorithm == Algorithm::os)
        return reconstruct(mir::sched::ShadingOnly{backend, executor}, gbuffer, vpls, visibility,
                           shading);
    const DeviceRows rows(backend, visibility);
    if (algorithm == Algorithm::rc)
        return reconstruct(mir::sched::Reconstruct{backend}, gbuffer, vpls, rows.visibility(),
                           shading);
    return reconstruct(mir::sched::ReconstructVisibilityParallel{backend}, gbuffer, vpls,
                       rows.visibility(), shading);
}

template <mir::Shading F>
mir::Image<mir::Rgb> reshade_on(const Backend& backend, Algorithm algorithm,
                                const LuxelsFor<F>& gbuffer, mir::VplSpan<mir::Space::host> vpls,
                                const mir::VisibilityMatrix& matrix, F shading) {
    mir::InlineExecutor executor;
    if (algorithm == Algorithm::os)
        return reshade(mir::sched::ShadingOnly{backend, executor}, gbuffer, vpls, matrix, shading);
    if (algorithm == Algorithm::rc)
        return reshade(mir::sched::Reconstruct{backend}, gbuffer, vpls, matrix, shading);
    return reshade(mir::sched::ReconstructVisibilityParallel{backend}, gbuffer, vpls, matrix,
                   shading);
}

mir::Image<mir::Rgb> reconstruct_pinned_on(
    const Backend& backend,
    const mir::BlockedGBuffer<mir::Lambert::Params, mir::cuda::PinnedAllocator<std::uint32_t>>&
        gbuffer,
    mir::VplSpan<mir::Space::host> vpls, HostSight visibility,
    mir::VplShading<mir::Lambert> shading) {
    const DeviceRows rows(backend, visibility);
    return reconstruct(mir::sched::ReconstructVisibilityParallel{backend}, gbuffer, vpls,
                       rows.visibility(), shading);
}

using Diffuse = mir::VplShading<mir::Lambert>;
using Glossy = mir::VplShading<mir::CookTorrance>;
using GlossyRest = mir::RemovedByBound<mir::CookTorrance>;

template mir::Image<mir::Rgb> reconstruct_on(const Backend&, Algorithm, const LuxelsFor<Diffuse>&,
                                             mir::VplSpan<mir::Space::host>, HostSight, Diffuse);
template mir::Image<mir::Rgb> reconstruct_on(const Backend&, Algorithm, const LuxelsFor<Glossy>&,
                                             mir::VplSpan<mir::Space::host>, HostSight, Glossy);
template mir::Image<mir::Rgb> reconstruct_on(const Backend&, Algorithm,
                                             const LuxelsFor<GlossyRest>&,
                                             mir::VplSpan<mir::Space::host>, HostSight, GlossyRest);
template mir::Image<mir::Rgb> reshade_on(const Backend&, Algorithm, const LuxelsFor<Diffuse>&,
                                         mir::VplSpan<mir::Space::host>,
                                         const mir::VisibilityMatrix&, Diffuse);

}  // namespace mirtest
