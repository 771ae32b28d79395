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

void NormalisationPass::add(RenderFrame& by, const FrameBand& band, VplSpan<Space::host> vpls,
                            BandTurn& turn, ResponseSum& sum) const {
    const auto stage = by.job().clock.measure(&StageSeconds::response);
    by.add_responses(band, vpls, bound_, turn, sum);
}

/// Responses over every luxel.
std::vector<ImageResponse> NormalisationPass::over_image(VplSpan<Space::host> vpls) {
    const RenderJob& job = frame_.job();
    ResponseSum sum(bands_.luxels(), vpls.size());
    // Bands of some rows alone are others.
    const bool keep = job.settings.normalisation == NormalisationPolicy::full &&
                      job.settings.rows.count == 0 && bands_.fit_together(vpls.size());
    if (keep) kept_.resize(bands_.count());
    frame_.for_each_band(bands_.count(), [&](RenderFrame& by, std::uint32_t i, BandTurn& turn) {
        BandPtr band = bands_.make(by, i);
        find_visible(by, *band, vpls);
        add(by, *band, vpls, turn, sum);
        if (keep) kept_[i] = std::move(band);
    });
    frame_.take_over(sum);
    const auto stage = job.clock.measure(&StageSeconds::response);
    return sum.mean();
}

/// Responses over a few luxels; over all for VPLs that few of those see.
std::vector<ImageResponse> NormalisationPass::probed(VplSpan<Space::host> vpls) {
    const RenderJob& job = frame_.job();
    const BandPtr probes = [&] {
        const auto stage = job.clock.measure(&StageSeconds::gbuffer);
        return frame_.trace(
            {job.rays.camera, job.aspect(), job.settings.prepass_luxels, job.settings.seed});
    }();
    find_visible(frame_, *probes, vpls);
    ResponseSum sum(probes->extent(), vpls.size());
    BandTurn only;
    add(frame_, *probes, vpls, only, sum);
    std::vector<ImageResponse> responses = sum.mean();
    const std::vector<VplIndex> poor = poorly_measured(responses);
    if (poor.empty()) return responses;
    std::vector<Vpl> again;
    for (VplIndex j : poor) again.push_back(vpls[j]);
    const std::vector<ImageResponse> better = over_image(span_of(again));
    for (std::size_t i = 0; i < poor.size(); ++i) responses[poor[i]] = better[i];
    return responses;
}

}  // namespace mir
