// SPDX-License-Identifier: MIT
#pragma once

#include "mir/fill_visibility.hpp"
#include "mir/normalise/normalise.hpp"
#include "mir/normalise/response.hpp"
#include "mir/runtime/vpl_frame.hpp"
#include "mir/sampling/metropolis_sampler.hpp"
#include "mir/shading/lambert.hpp"
#include "reference/studio.hpp"
#include "runtime/sample_vpls.hpp"
#include "support/free_sight.hpp"

namespace mirtest {

/// Chains of a render of `studio`, told of any bound.
inline auto chains(const Studio<mir::Lambert>& studio, const mir::RenderSettings& settings,
                   float bound) {
    const float aspect =
        static_cast<float>(settings.image.width) / static_cast<float>(settings.image.height);
    const mir::PathWorld<mir::Lambert, mir::cpu::EmbreeRayCaster, mir::cpu::EmbreeVisibility> world{
        studio.geometry,
        studio.lights,
        studio.surfaces,
        studio.engine.ray_caster(),
        studio.engine.visibility(),
        studio.scene.cameras[settings.camera],
        aspect,
        bound};
    return mir::MetropolisSampler(world, mir::metropolis_options(settings));
}

/// Responses of VPLs over the luxels of a render.
template <mir::Bsdf B, class V>
std::vector<mir::ImageResponse> responses(const Studio<B>& studio,
                                          const mir::RenderSettings& settings,
                                          const mir::VplList& vpls, float bound, V visibility) {
    const mir::CameraRays rays{studio.scene.cameras[settings.camera],
                               mir::luxel_grid(settings.image, settings.luxels_per_pixel),
                               settings.seed};
    const mir::Extent luxels = rays.grid.luxels();
    mir::BlockedGBuffer<typename B::Params> gbuffer(luxels, luxels);
    mir::TbbExecutor executor;
    mir::fill_gbuffer<B>(gbuffer, 0, rays, studio.engine.ray_caster(), studio.surfaces, executor);
    mir::VisibilityMatrix matrix(gbuffer.tiles(), vpls.size());
    mir::fill_visibility(matrix, gbuffer, vpls.span(), visibility, executor);
    return mir::response(gbuffer, vpls.span(), matrix, mir::VplShading<B>{bound}, executor);
}

/// Records whose intensities are final, as a Sampler. The renderer takes them as they are.
struct FinalRecords {
    static constexpr mir::Normalisation normalisation = mir::Normalisation::none;

    mir::VplRecords records;

    template <mir::Executor E>
    [[nodiscard]] mir::VplRecords sample(E& /*executor*/) const {
        return records;
    }
};

/// Records that the renderer is to normalise, as a Sampler.
struct Given {
    static constexpr mir::Normalisation normalisation = mir::Normalisation::image_response;

    mir::VplRecords records;

    template <mir::Executor E>
    [[nodiscard]] mir::VplRecords sample(E& /*executor*/) const {
        return records;
    }
};

/// Records with the intensities of a list that was aggregated from them.
inline FinalRecords relit(mir::VplRecords records, const mir::VplList& list) {
    for (std::size_t i = 0; i < records.records.size(); ++i)
        records.records[i].vpl.intensity = list.path_vpls()[i].intensity;
    std::erase_if(records.records,
                  [](const mir::VplRecord& r) { return is_black(r.vpl.intensity); });
    return {std::move(records)};
}

/// The renderer with a sampler of the test's own.
template <mir::Sampler S>
mir::RenderResult render(const Studio<mir::Lambert>& studio, const mir::RenderSettings& settings,
                         const S& sampler) {
    mir::RenderSettings by_embree = settings;
    by_embree.acceleration = mir::Acceleration::embree;
    mir::VplFrame frame(studio.scene, by_embree);
    return render_vpls(frame, {sampler.sample(frame.executor()), S::normalisation});
}

}  // namespace mirtest
