// SPDX-License-Identifier: MIT
#pragma once

#include "mir/normalise/normalise.hpp"
#include "mir/normalise/prepass.hpp"
#include "mir/runtime/image_bands.hpp"
#include "mir/sampling/probe_rays.hpp"

namespace mir {

/// The normalisation stage of a render: finds what each VPL does to the image and makes intensities
/// of the radiance that the sampler gave (docs/method.md, 10).
template <Bsdf B, class Engine, Executor E, Shading F>
class NormalisationPass {
 public:
    using Context = RenderContext<B, Engine, E>;           ///< of the render
    using Band = typename ImageBands<B, Engine, E>::Band;  ///< luxels with their visibility

    /// `shading` is the one that the sampler's P_c was measured with and that the image will use.
    NormalisationPass(const Context& context, const ImageBands<B, Engine, E>& bands,
                      const F& shading)
        : context_(context), bands_(bands), shading_(shading) {}

    /// Replaces the radiance in `vpls` by intensities, by the policy of the settings.
    NormalisationReport run(VplList& vpls, double path_luminance, double states) {
        const bool probes = context_.settings.normalisation == NormalisationPolicy::prepass;
        const std::vector<ImageResponse> responses =
            probes ? probed(vpls.span()) : over_image(vpls.span());
        const auto stage = context_.clock.measure(&StageSeconds::response);
        return normalise(vpls, responses, path_luminance, states);
    }

    /// All bands with their visibility, if they fit into memory together and were needed; else
    /// none. Leaves the pass without them.
    [[nodiscard]] std::vector<Band> take_bands() { return std::move(kept_); }

 private:
    [[nodiscard]] std::vector<ImageResponse> over_image(VplSpan<Space::host> vpls);
    [[nodiscard]] std::vector<ImageResponse> probed(VplSpan<Space::host> vpls);
    [[nodiscard]] Band probe_luxels() const;

    /// An empty sum over an image of `luxels`.
    [[nodiscard]] auto no_response(Extent luxels, std::uint32_t vpls) const {
        if constexpr (BandEngine<Engine>)
            return context_.engine.response(luxels, vpls);
        else
            return ResponseSum(luxels, vpls);
    }
    void add(const Band& band, VplSpan<Space::host> vpls, auto& sum) const {
        const auto stage = context_.clock.measure(&StageSeconds::response);
        if constexpr (BandEngine<Engine>)
            sum.add(band.luxels, vpls, shading_);
        else
            sum.add_band(band.gbuffer, vpls, band.visibility->view(), shading_, context_.executor);
    }

    Context context_;
    const ImageBands<B, Engine, E>& bands_;
    F shading_;
    std::vector<Band> kept_;
};

/// Responses over every luxel.
template <Bsdf B, class Engine, Executor E, Shading F>
std::vector<ImageResponse> NormalisationPass<B, Engine, E, F>::over_image(
    VplSpan<Space::host> vpls) {
    auto sum = no_response(bands_.luxels(), vpls.size());
    const bool keep = context_.settings.normalisation == NormalisationPolicy::full &&
                      bands_.fit_together(vpls.size());
    for (std::uint32_t i = 0; i < bands_.count(); ++i) {
        Band band = bands_.make(i);
        bands_.find_visible(band, vpls);
        add(band, vpls, sum);
        if (keep) kept_.push_back(std::move(band));
    }
    const auto stage = context_.clock.measure(&StageSeconds::response);
    return sum.mean();
}

/// Responses over a few luxels; over all for VPLs that few of those see.
template <Bsdf B, class Engine, Executor E, Shading F>
std::vector<ImageResponse> NormalisationPass<B, Engine, E, F>::probed(VplSpan<Space::host> vpls) {
    Band probes = probe_luxels();
    bands_.find_visible(probes, vpls);
    auto sum = no_response(probes.extent(), vpls.size());
    add(probes, vpls, sum);
    std::vector<ImageResponse> responses = sum.mean();
    const std::vector<VplIndex> poor = poorly_measured(responses);
    if (poor.empty()) return responses;
    std::vector<Vpl> again;
    for (VplIndex j : poor) again.push_back(vpls[j]);
    const std::vector<ImageResponse> better = over_image(span_of(again));
    for (std::size_t i = 0; i < poor.size(); ++i) responses[poor[i]] = better[i];
    return responses;
}

template <Bsdf B, class Engine, Executor E, Shading F>
auto NormalisationPass<B, Engine, E, F>::probe_luxels() const -> Band {
    const auto stage = context_.clock.measure(&StageSeconds::gbuffer);
    const RenderSettings& s = context_.settings;
    const ProbeRays rays{context_.rays.camera, context_.aspect(), s.prepass_luxels, s.seed};
    const Extent cells = rays.cells();
    BlockedGBuffer<typename B::Params> gbuffer(cells, whole_blocks(cells));
    fill_gbuffer<B>(gbuffer, 0, rays, context_.engine.ray_caster(), context_.surfaces,
                    context_.executor);
    if constexpr (BandEngine<Engine>)
        return {0, context_.engine.upload(gbuffer)};
    else
        return {0, std::move(gbuffer), {}};
}

}  // namespace mir
