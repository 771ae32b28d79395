// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/render_context.hpp"
#include "mir/shading/vpl_shading.hpp"

namespace mir {

/// Light that the VPLs of a render send through the luxels of a band, on a canvas (HostCanvas).
/// `vpls` must outlive it.
template <Bsdf B>
class VplLight {
 public:
    VplLight(const RenderSettings& settings, const VplShading<B>& shading, const VplList& vpls)
        : shading_(shading), vpls_(vpls) {
        if (!settings.bounce_layers) return;
        // What is traced back may have bounced more often than any VPL.
        layers_ = settings.compensate > 0 ? settings.max_bounce : vpls.max_bounce();
        for (std::uint8_t b = 1; b <= vpls.max_bounce(); ++b) bounces_.push_back(vpls.bounce(b));
    }

    /// Bounces that get a layer of their own.
    [[nodiscard]] std::size_t bounces() const { return layers_; }

    /// Appends the light of all VPLs, W m^-2 sr^-1, and that of each bounce behind it. `monitor`
    /// may be null.
    template <class Canvas>
    void append_layers(const Canvas& canvas, const typename Canvas::Band& band, Monitor* monitor,
                       std::vector<typename Canvas::Layer>& layers) const {
        if (layers_ == 0)
            return layers.push_back(canvas.light(band, vpls_.span(), shading_, monitor));
        const std::size_t sum = layers.size();
        layers.push_back(canvas.black(band));
        for (const std::vector<Vpl>& bounce : bounces_) {
            layers.push_back(canvas.light(band, span_of(bounce), shading_, monitor));
            canvas.add(layers[sum], layers.back());
        }
        while (layers.size() <= sum + layers_) layers.push_back(canvas.black(band));
    }

    /// The light that the bound keeps from the image.
    template <class Canvas>
    [[nodiscard]] typename Canvas::Layer removed(const Canvas& canvas,
                                                 const typename Canvas::Band& band) const {
        return canvas.light(band, vpls_.span(), RemovedByBound<B>{shading_.bound}, nullptr);
    }

 private:
    VplShading<B> shading_;
    const VplList& vpls_;
    std::size_t layers_ = 0;
    std::vector<std::vector<Vpl>> bounces_;
};

}  // namespace mir
