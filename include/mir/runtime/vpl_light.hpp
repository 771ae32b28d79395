// SPDX-License-Identifier: MIT
#pragma once

#include "mir/reshade.hpp"
#include "mir/runtime/image_bands.hpp"
#include "mir/shading/vpl_shading.hpp"

namespace mir {

/// Light that the VPLs of a render send through the luxels of a band: from the band's visibility
/// where it is known, by tracing otherwise. `vpls` must outlive it.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
class VplLight {
 public:
    using Band = typename ImageBands<B, Engine, E>::Band;

    VplLight(const RenderContext<B, Engine, E>& context, MakeScheduler make_scheduler,
             const VplShading<B>& shading, const VplList& vpls)
        : context_(context), make_scheduler_(make_scheduler), shading_(shading), vpls_(vpls) {
        if (!context.settings.bounce_layers) return;
        for (std::uint8_t b = 1; b <= vpls.max_bounce(); ++b) bounces_.push_back(vpls.bounce(b));
    }

    /// Bounces that get a layer of their own.
    [[nodiscard]] std::size_t bounces() const { return bounces_.size(); }

    /// Appends the light of all VPLs, W m^-2 sr^-1, and that of each bounce behind it.
    void append_layers(const Band& band, std::vector<Image<Rgb>>& layers) const {
        const Stopwatch watch(context_.seconds.reconstruction);
        if (bounces_.empty())
            return layers.push_back(light(band, vpls_.span(), shading_, context_.monitor));
        const std::size_t sum = layers.size();
        layers.emplace_back(band.gbuffer.extent());
        for (const std::vector<Vpl>& bounce : bounces_) {
            layers.push_back(light(band, span_of(bounce), shading_, context_.monitor));
            const auto total = layers[sum].pixels();
            for (std::size_t i = 0; i < total.size(); ++i) total[i] += layers.back().pixels()[i];
        }
    }

    /// The light that the bound keeps from the image.
    [[nodiscard]] Image<Rgb> removed(const Band& band) const {
        return light(band, vpls_.span(), RemovedByBound<B>{shading_.bound}, nullptr);
    }

 private:
    template <Shading F>
    [[nodiscard]] Image<Rgb> light(const Band& band, VplSpan<Space::host> vpls, const F& shading,
                                   Monitor* monitor) const {
        if constexpr (BandEngine<Engine>) {
            return context_.engine.light(band.kept, band.gbuffer, vpls, shading, monitor);
        } else {
            const auto scheduler = make_scheduler_(context_.executor, monitor);
            if (band.visibility)
                return reshade(scheduler, band.gbuffer, vpls, *band.visibility, shading);
            return reconstruct(scheduler, band.gbuffer, vpls, context_.engine.visibility(),
                               shading);
        }
    }

    RenderContext<B, Engine, E> context_;
    MakeScheduler make_scheduler_;
    VplShading<B> shading_;
    const VplList& vpls_;
    std::vector<std::vector<Vpl>> bounces_;
};

}  // namespace mir
