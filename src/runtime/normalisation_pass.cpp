// SPDX-License-Identifier: MIT
#include "runtime/normalisation_pass.hpp"

#include "mir/normalise/prepass.hpp"

namespace mir {

NormalisationReport NormalisationPass::run(VplList& vpls, double path_luminance, double states) {
    const RenderJob& job = frame_.job();
    const bool probes = job.settings.normalisation == NormalisationPolicy::prepass;
    const std::vector<ImageResponse> responses =
        probes ? probed(vpls.span()) : over_image(vpls.span());
    const auto stage = job.clock.measure(&StageSeconds::response);
    return normalise(vpls, responses, path_luminance, states);
}

void NormalisationPass::add(const FrameBand& band, VplSpan<Space::host> vpls,
                            FrameResponse& sum) const {
    const auto stage = frame_.job().clock.measure(&StageSeconds::response);
    sum.add(band, vpls);
}

/// Responses over every luxel.
std::vector<ImageResponse> NormalisationPass::over_image(VplSpan<Space::host> vpls) {
    const RenderJob& job = frame_.job();
    const ResponsePtr sum = frame_.response(bands_.luxels(), vpls.size(), bound_);
    const bool keep =
        job.settings.normalisation == NormalisationPolicy::full && bands_.fit_together(vpls.size());
    for (std::uint32_t i = 0; i < bands_.count(); ++i) {
        BandPtr band = bands_.make(i);
        bands_.find_visible(*band, vpls);
        add(*band, vpls, *sum);
        if (keep) kept_.push_back(std::move(band));
    }
    const auto stage = job.clock.measure(&StageSeconds::response);
    return sum->mean();
}

/// Responses over a few luxels; over all for VPLs that few of those see.
std::vector<ImageResponse> NormalisationPass::probed(VplSpan<Space::host> vpls) {
    const RenderJob& job = frame_.job();
    const BandPtr probes = [&] {
        const auto stage = job.clock.measure(&StageSeconds::gbuffer);
        return frame_.trace(
            {job.rays.camera, job.aspect(), job.settings.prepass_luxels, job.settings.seed});
    }();
    bands_.find_visible(*probes, vpls);
    const ResponsePtr sum = frame_.response(probes->extent(), vpls.size(), bound_);
    add(*probes, vpls, *sum);
    std::vector<ImageResponse> responses = sum->mean();
    const std::vector<VplIndex> poor = poorly_measured(responses);
    if (poor.empty()) return responses;
    std::vector<Vpl> again;
    for (VplIndex j : poor) again.push_back(vpls[j]);
    const std::vector<ImageResponse> better = over_image(span_of(again));
    for (std::size_t i = 0; i < poor.size(); ++i) responses[poor[i]] = better[i];
    return responses;
}

}  // namespace mir
