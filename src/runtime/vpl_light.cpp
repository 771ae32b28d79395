// SPDX-License-Identifier: MIT
#include "runtime/vpl_light.hpp"

#include "mir/core/limits.hpp"

namespace mir {
namespace {

using Kind = VplKernel::Kind;

Kind kind_of(const RenderSettings& s) {
    if (s.vsl.enabled) return Kind::spheres;
    return s.glossy.enabled ? Kind::lobes : Kind::points;
}

}  // namespace

VplLight::VplLight(const RenderSettings& settings, float bound, const VplList& vpls,
                   AnyExecutor executor)
    : vpls_(vpls),
      lit_{kind_of(settings), bound},
      removed_{settings.glossy.enabled ? Kind::removed_of_lobes : Kind::removed, bound} {
    if (settings.bounce_layers) {
        // What is traced back may have bounced more often than any VPL.
        layers_ = settings.compensate > 0 ? settings.bounce_limit() : vpls.max_bounce();
        for (std::uint8_t b = 1; b <= vpls.max_bounce(); ++b) bounces_.push_back(vpls.bounce(b));
    }
    if (settings.sum != LightSum::cuts) return;
    check_limit(VplTree::bytes_for(vpls.size()), settings.limits.vpl_tree_bytes, "vpl_tree_bytes");
    if (layers_ == 0) cut_vpls_.emplace_back(vpls.span(), executor);
    for (const std::vector<Vpl>& bounce : bounces_)
        cut_vpls_.emplace_back(span_of(bounce), executor);
}

void VplLight::append_layers(RenderFrame& frame, const FrameBand& band, FrameLayer* variance,
                             Monitor* monitor, std::vector<LayerPtr>& layers) const {
    if (layers_ == 0) {
        layers.push_back(light(frame, band, 0, variance, monitor));
        return;
    }
    const std::size_t sum = layers.size();
    layers.push_back(frame.black(band));
    for (std::size_t i = 0; i < bounces_.size(); ++i) {
        layers.push_back(light(frame, band, i, variance, monitor));
        frame.add(*layers[sum], *layers.back());
    }
    while (layers.size() <= sum + layers_) layers.push_back(frame.black(band));
}

/// Of all VPLs, or of those of one bounce where there are layers of these.
LayerPtr VplLight::light(RenderFrame& frame, const FrameBand& band, std::size_t list,
                         FrameLayer* variance, Monitor* monitor) const {
    if (!cut_vpls_.empty() && variance != nullptr)
        return frame.light_and_error_by_cuts(band, cut_vpls_[list], lit_.bound, *variance, monitor);
    if (!cut_vpls_.empty()) return frame.light_by_cuts(band, cut_vpls_[list], lit_.bound, monitor);
    return frame.light(band, layers_ == 0 ? vpls_.span() : span_of(bounces_[list]), lit_, monitor);
}

}  // namespace mir
