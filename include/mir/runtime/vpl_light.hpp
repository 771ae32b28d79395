// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/render_context.hpp"
#include "mir/shading/glossy_shading.hpp"
#include "mir/shading/vsl_shading.hpp"

namespace mir {

/// What the VPLs of a render have beside place and intensity, by their index.
template <Bsdf B>
struct VplDetails {
    std::vector<float> radii;       ///< of virtual spherical lights, metres; none: points
    std::vector<VplLobe<B>> lobes;  ///< of their surfaces; none: all are Lambertian
};

/// Light that the VPLs of a render send through the luxels of a band, on a canvas (HostCanvas).
/// `vpls` must outlive it.
template <Bsdf B>
class VplLight {
 public:
    /// Of VPLs that `shading` lights luxels by, details apart.
    VplLight(const RenderSettings& settings, const VplShading<B>& shading, const VplList& vpls,
             VplDetails<B> details)
        : shading_(shading),
          vpls_(vpls),
          sphere_{0.0f, settings.vsl.samples, settings.seed},
          details_(std::move(details)) {
        if (!settings.bounce_layers) return;
        // What is traced back may have bounced more often than any VPL.
        layers_ = settings.compensate > 0 ? settings.bounce_limit() : vpls.max_bounce();
        for (std::uint8_t b = 1; b <= vpls.max_bounce(); ++b) bounces_.push_back(vpls.bounce(b));
    }

    /// Bounces that get a layer of their own.
    [[nodiscard]] std::size_t bounces() const { return layers_; }

    /// Appends the light of all VPLs, W m^-2 sr^-1, and that of each bounce behind it. `monitor`
    /// may be null.
    template <class Canvas>
    void append_layers(const Canvas& canvas, const typename Canvas::Band& band, Monitor* monitor,
                       std::vector<typename Canvas::Layer>& layers) const {
        if (layers_ == 0) return layers.push_back(light(canvas, band, vpls_.span(), monitor));
        const std::size_t sum = layers.size();
        layers.push_back(canvas.black(band));
        for (const std::vector<Vpl>& bounce : bounces_) {
            layers.push_back(light(canvas, band, span_of(bounce), monitor));
            canvas.add(layers[sum], layers.back());
        }
        while (layers.size() <= sum + layers_) layers.push_back(canvas.black(band));
    }

    /// The light that the bound keeps from the image.
    template <class Canvas>
    [[nodiscard]] typename Canvas::Layer removed(const Canvas& canvas,
                                                 const typename Canvas::Band& band) const {
        if constexpr (takes_details<Canvas>)
            if (!details_.lobes.empty())
                return canvas.glossy(band, vpls_.span(), details_.lobes, {shading_.bound, true},
                                     nullptr);
        return canvas.light(band, vpls_.span(), RemovedByBound<B>{shading_.bound}, nullptr);
    }

 private:
    /// True of canvases that know what to do with details; others are given none.
    template <class Canvas>
    static constexpr bool takes_details = requires {
        typename Canvas::TakesVplDetails;
    };

    template <class Canvas>
    [[nodiscard]] typename Canvas::Layer light(const Canvas& canvas,
                                               const typename Canvas::Band& band,
                                               VplSpan<Space::host> vpls, Monitor* monitor) const {
        if constexpr (takes_details<Canvas>) {
            if (!details_.radii.empty())
                return canvas.spheres(band, vpls, details_.radii, sphere_, monitor);
            if (!details_.lobes.empty())
                return canvas.glossy(band, vpls, details_.lobes, {shading_.bound}, monitor);
        }
        return canvas.light(band, vpls, shading_, monitor);
    }

    VplShading<B> shading_;
    const VplList& vpls_;
    VslShading<B> sphere_;
    VplDetails<B> details_;
    std::size_t layers_ = 0;
    std::vector<std::vector<Vpl>> bounces_;
};

}  // namespace mir
