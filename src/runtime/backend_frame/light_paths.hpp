// SPDX-License-Identifier: MIT
#pragma once

// Light paths of BackendFrame: VPLs, and what they say of P_c.

#include "mir/resident/backend_light_paths.hpp"
#include "mir/resident/backend_path_luminance.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "runtime/backend_frame/structures.hpp"
#include "runtime/path_probe.hpp"

namespace mir {

template <Backend M, Bsdf B>
VplRecords BackendFrame<M, B>::sample_light_paths(const InstantRadiosityOptions& options) {
    if (options.arrivals) throw without(FrameFeature::lobes);
    return with_rays([&](const auto& rays) {
        using Caster = typename std::remove_cvref_t<decltype(rays)>::Caster;
        const BackendLightPaths<M, B, Caster> paths(
            machine_,
            {geometry_there_.view(), lights_.view(), surfaces_.view(),
             rays.caster(geometry_there_.view())},
            options, job_.settings.limits);
        return paths.sample(queue_, job_.lights, std::get<SurfaceTable<B>>(job_.surfaces),
                            job_.monitor);
    });
}

template <Backend M, Bsdf B>
PathLuminance BackendFrame<M, B>::light_path_luminance(const VplRecords& sampled, float bound) {
    const BandPtr luxels = trace(path_probe(job_));
    return with_rays([&](const auto& rays) {
        return backend_path_luminance<M, B>(machine_, queue_, sampled, of(*luxels).gbuffer,
                                            rays.sight(), VplShading<B>{bound});
    });
}

}  // namespace mir
