// SPDX-License-Identifier: MIT
#include "runtime/vpl_light.hpp"

namespace mir {
namespace {

using Kind = VplKernel::Kind;

Kind kind_of(const RenderSettings& s) {
    if (s.vsl.enabled) return Kind::spheres;
    return s.glossy.enabled ? Kind::lobes : Kind::points;
}

}  // namespace

VplLight::VplLight(const RenderSettings& settings, float bound, const VplList& vpls)
    : vpls_(vpls),
      lit_{kind_of(settings), bound},
      removed_{settings.glossy.enabled ? Kind::removed_of_lobes : Kind::removed, bound} {
    if (!settings.bounce_layers) return;
    // What is traced back may have bounced more often than any VPL.
    layers_ = settings.compensate > 0 ? settings.bounce_limit() : vpls.max_bounce();
    for (std::uint8_t b = 1; b <= vpls.max_bounce(); ++b) bounces_.push_back(vpls.bounce(b));
}

void VplLight::append_layers(RenderFrame& frame, const FrameBand& band, Monitor* monitor,
                             std::vector<LayerPtr>& layers) const {
    if (layers_ == 0) {
        layers.push_back(frame.light(band, vpls_.span(), lit_, monitor));
        return;
    }
    const std::size_t sum = layers.size();
    layers.push_back(frame.black(band));
    for (const std::vector<Vpl>& bounce : bounces_) {
        layers.push_back(frame.light(band, span_of(bounce), lit_, monitor));
        frame.add(*layers[sum], *layers.back());
    }
    while (layers.size() <= sum + layers_) layers.push_back(frame.black(band));
}

}  // namespace mir
