// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/render_context.hpp"
#include "mir/runtime/sampling_engine.hpp"
#include "mir/sampling/bidirectional_sampler.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/sampling/metropolis_sampler.hpp"
#include "mir/sampling/proposal_sampler.hpp"
#include "mir/sampling/vpl_roulette.hpp"

namespace mir {

/// Options of a sampler with what every sampler is told of the settings.
template <class Options>
Options with_common(Options options, const RenderSettings& settings) {
    options.emitter_vpls = settings.direct == DirectLight::vpl;
    options.max_bounce = settings.bounce_limit();
    options.seed = settings.seed;
    return options;
}

/// Light paths of instant radiosity, as the settings want them.
inline InstantRadiosityOptions light_path_options(const RenderSettings& settings) {
    InstantRadiosityOptions options;
    options.vpls = settings.vpls;
    options.termination = settings.termination;
    options.sequence = settings.sequence;
    options.arrivals = settings.glossy.enabled;
    return with_common(options, settings);
}

/// A few luxels that tell what VPLs give to the image of a render.
template <Bsdf B, class Engine, Executor E>
auto image_probe(const RenderContext<B, Engine, E>& c, float bound) {
    const ProbeRays rays{c.rays.camera, c.aspect(), 256, c.settings.seed};
    return ImageProbe<B, decltype(c.engine.visibility())>(
        rays, c.engine.ray_caster(), c.surfaces, c.engine.visibility(), VplShading<B>{bound});
}

/// What full paths of a render run through. `bound` is the largest geometry term of the shading to
/// come, m^-2: samplers that look at the image must use the same.
template <Bsdf B, class Engine, Executor E>
auto path_world(const RenderContext<B, Engine, E>& c, const LightTable& lights, float bound) {
    return PathWorld<B, decltype(c.engine.ray_caster()), decltype(c.engine.visibility())>{
        c.geometry,    lights,     c.surfaces, c.engine.ray_caster(), c.engine.visibility(),
        c.rays.camera, c.aspect(), bound};
}

/// How chains are to run.
inline MetropolisOptions metropolis_options(const RenderSettings& settings) {
    MetropolisOptions options{settings.metropolis};
    options.states = settings.vpls;
    return with_common(options, settings);
}

/// How resampled light paths are to be drawn.
inline BidirectionalOptions bidirectional_options(const RenderSettings& settings) {
    BidirectionalOptions options;
    options.vpls = settings.vpls;
    return with_common(options, settings);
}

/// Whether the sampler of the settings must know beforehand what VPLs give to the image.
inline bool needs_probe(const RenderSettings& s) {
    if (s.sampler == SamplerKind::instant_radiosity) return s.vpl_roulette;
    return s.sampler == SamplerKind::bidirectional ||
           s.normalisation == NormalisationPolicy::proposal;
}

/// Calls `use` with the sampler that the settings name and returns what it returns.
/// @throws Error for options out of range.
template <Bsdf B, class Engine, Executor E, class Use>
auto with_sampler(const RenderContext<B, Engine, E>& c, const LightTable& lights, float bound,
                  const Use& use) {
    const RenderSettings& s = c.settings;
    using LightPaths = InstantRadiositySampler<B, decltype(c.engine.ray_caster())>;
    // With direct light alone, and not by VPLs, there is nothing to sample: light paths know that.
    const bool any = s.bounce_limit() > 1 || s.direct == DirectLight::vpl;
    const bool by_chains = any && s.sampler == SamplerKind::metropolis;
    if constexpr (SamplingEngine<Engine>)
        if (by_chains && !needs_probe(s))
            return use(EngineMetropolis<Engine>{c.engine,
                                                lights,
                                                {c.rays.camera.optics(), c.aspect(), bound},
                                                metropolis_options(s),
                                                s.limits,
                                                c.monitor});
    const auto paths = path_world(c, lights, bound);
    const typename LightPaths::World light_paths{c.geometry, lights, c.surfaces,
                                                 c.engine.ray_caster()};
    if (!any || !needs_probe(s)) {
        if constexpr (!SamplingEngine<Engine>)
            if (by_chains) return use(MetropolisSampler(paths, metropolis_options(s), s.limits));
        return use(LightPaths(light_paths, light_path_options(s), s.limits));
    }
    const auto probe = image_probe(c, bound);
    if (s.sampler == SamplerKind::metropolis)
        return use(ProposalSampler(paths, probe, metropolis_options(s), {}, s.limits));
    if (s.sampler == SamplerKind::bidirectional)
        return use(BidirectionalSampler(paths, probe, bidirectional_options(s), s.limits));
    using Roulette = RouletteRadiositySampler<B, decltype(c.engine.ray_caster()),
                                              decltype(c.engine.visibility())>;
    return use(Roulette(light_paths, light_path_options(s), probe, {}, s.limits));
}

/// What a sampler recorded, and what is left to do to it.
struct SampledVpls {
    VplRecords records;                                 ///< as they come from the sampler
    Normalisation normalisation = Normalisation::none;  ///< none: intensities are final
};

/// Places VPLs with the sampler that the settings name; `bound` as for path_world().
/// @throws Error for options out of range, and what the sampler throws.
template <Bsdf B, class Engine, Executor E>
SampledVpls sample_vpls(const RenderContext<B, Engine, E>& c, const LightTable& lights,
                        float bound) {
    return with_sampler(c, lights, bound, [&c](const auto& sampler) {
        return SampledVpls{sampler.sample(c.executor), sampler.normalisation};
    });
}

}  // namespace mir
