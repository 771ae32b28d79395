// SPDX-License-Identifier: MIT
#include "runtime/sample_vpls.hpp"

#include "mir/sampling/bidirectional_sampler.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/sampling/light_path_luminance.hpp"
#include "mir/sampling/metropolis_sampler.hpp"
#include "mir/sampling/proposal_sampler.hpp"
#include "mir/sampling/vpl_roulette.hpp"
#include "runtime/path_probe.hpp"

namespace mir {
namespace {

/// Options of a sampler with what every sampler is told of the settings.
template <class Options>
Options with_common(Options options, const RenderSettings& settings) {
    options.emitter_vpls = settings.direct == DirectLight::vpl;
    options.max_bounce = settings.bounce_limit();
    options.seed = settings.seed;
    return options;
}

InstantRadiosityOptions light_path_options(const RenderSettings& settings) {
    InstantRadiosityOptions options;
    options.vpls = settings.vpls;
    options.termination = settings.termination;
    options.sequence = settings.sequence;
    options.arrivals = settings.glossy.enabled;
    return with_common(options, settings);
}

BidirectionalOptions bidirectional_options(const RenderSettings& settings) {
    BidirectionalOptions options;
    options.vpls = settings.vpls;
    return with_common(options, settings);
}

/// A few luxels that tell what VPLs give to the image of a render.
template <Bsdf B>
auto image_probe(const RenderJob& job, const SurfaceTable<B>& surfaces, const AnyEngine& rays,
                 float bound) {
    return ImageProbe<B, AnyVisibility>(path_probe(job), rays.ray_caster(), surfaces,
                                        rays.visibility(), VplShading<B>{bound});
}

/// What full paths of a render run through.
template <Bsdf B>
auto path_world(const RenderJob& job, const SurfaceTable<B>& surfaces, const AnyEngine& rays,
                float bound) {
    return PathWorld<B, AnyRayCaster, AnyVisibility>{
        job.geometry,      job.lights,      surfaces,     rays.ray_caster(),
        rays.visibility(), job.rays.camera, job.aspect(), bound};
}

/// With direct light alone, and not by VPLs, there is nothing to sample. Light paths know that.
bool has_nothing_to_sample(const RenderSettings& s) {
    return s.bounce_limit() <= 1 && s.direct != DirectLight::vpl;
}

/// Whether the sampler of the settings must know beforehand what VPLs give to the image.
bool needs_probe(const RenderSettings& s) {
    if (has_nothing_to_sample(s)) return false;
    if (s.sampler == SamplerKind::instant_radiosity) return s.vpl_roulette;
    return s.sampler == SamplerKind::bidirectional ||
           s.normalisation_policy() == NormalisationPolicy::proposal;
}

/// Calls use(sampler) with the one that the settings name, of those that need a probe.
template <Bsdf B, class Use>
auto with_sampler(const RenderJob& job, const SurfaceTable<B>& surfaces, const AnyEngine& rays,
                  float bound, const Use& use) {
    const RenderSettings& s = job.settings;
    const auto paths = path_world(job, surfaces, rays, bound);
    const auto probe = image_probe(job, surfaces, rays, bound);
    if (s.sampler == SamplerKind::metropolis)
        return use(ProposalSampler(paths, probe, metropolis_options(s), {}, s.limits));
    if (s.sampler == SamplerKind::bidirectional)
        return use(BidirectionalSampler(paths, probe, bidirectional_options(s), s.limits));
    using Roulette = RouletteRadiositySampler<B, AnyRayCaster, AnyVisibility>;
    return use(Roulette({job.geometry, job.lights, surfaces, rays.ray_caster()},
                        light_path_options(s), probe, {}, s.limits));
}

/// Light paths, and how well they know P_c where that is wanted.
SampledVpls sample_light_paths(RenderFrame& frame, float bound) {
    const RenderSettings& s = frame.job().settings;
    SampledVpls sampled{frame.sample_light_paths(light_path_options(s)), Normalisation::none};
    if (s.sampler == SamplerKind::instant_radiosity && s.measure_missing)
        sampled.records.light_paths = frame.light_path_luminance(sampled.records, bound);
    return sampled;
}

}  // namespace

MetropolisOptions metropolis_options(const RenderSettings& settings) {
    MetropolisOptions options{settings.metropolis};
    options.states = settings.vpls;
    return with_common(options, settings);
}

SampledVpls sample_vpls(RenderFrame& frame, float bound) {
    RenderJob& job = frame.job();
    const RenderSettings& s = job.settings;
    if (needs_probe(s)) {
        const AnyEngine& rays = frame.rays();
        return job.with_surfaces([&](const auto& surfaces) {
            return with_sampler(job, surfaces, rays, bound, [&job](const auto& sampler) {
                return SampledVpls{sampler.sample(job.executor), sampler.normalisation};
            });
        });
    }
    if (s.sampler == SamplerKind::metropolis && !has_nothing_to_sample(s))
        return {frame.sample_chains(metropolis_options(s), bound), Normalisation::image_response};
    return sample_light_paths(frame, bound);
}

VplRecords sample_light_paths_on_host(RenderFrame& frame, const InstantRadiosityOptions& options) {
    RenderJob& job = frame.job();
    const AnyEngine& rays = frame.rays();
    return job.with_surfaces([&]<Bsdf B>(const SurfaceTable<B>& surfaces) {
        return InstantRadiositySampler<B, AnyRayCaster>(
                   {job.geometry, job.lights, surfaces, rays.ray_caster()}, options,
                   job.settings.limits)
            .sample(job.executor);
    });
}

PathLuminance light_path_luminance_on_host(RenderFrame& frame, const VplRecords& sampled,
                                           float bound) {
    RenderJob& job = frame.job();
    const AnyEngine& rays = frame.rays();
    return job.with_surfaces([&](const auto& surfaces) {
        return light_path_luminance(sampled, image_probe(job, surfaces, rays, bound), job.executor);
    });
}

VplRecords sample_chains_on_host(RenderFrame& frame, const MetropolisOptions& options, float bound,
                                 const SharedDraw& shared) {
    RenderJob& job = frame.job();
    const AnyEngine& rays = frame.rays();
    return job.with_surfaces([&](const auto& surfaces) {
        return MetropolisSampler(path_world(job, surfaces, rays, bound), options,
                                 job.settings.limits)
            .sample(job.executor, shared);
    });
}

}  // namespace mir
