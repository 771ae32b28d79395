// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/runtime/settings.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>

namespace mir {

/// What some frames (RenderFrame) can do and others cannot.
enum class FrameFeature {
    embree,     ///< Acceleration::embree
    spheres,    ///< VslSettings
    lobes,      ///< GlossySettings
    pick_error  ///< RenderSettings::pick_error_layer
};

/// Features of a kind of frame.
class FrameFeatures {
 public:
    /// These alone.
    constexpr FrameFeatures(std::initializer_list<FrameFeature> features) {
        for (const FrameFeature f : features) bits_ |= 1u << static_cast<unsigned>(f);
    }
    /// Whether it is one of them.
    [[nodiscard]] constexpr bool has(FrameFeature f) const {
        return (bits_ >> static_cast<unsigned>(f) & 1u) != 0;
    }

 private:
    unsigned bits_ = 0;
};

/// Why a frame without the feature cannot render, and what to do. A sentence without its end.
[[nodiscard]] inline std::string reason_without(FrameFeature feature) {
    switch (feature) {
        case FrameFeature::embree:
            return "Embree traces on the processor only (this backend traces on a GPU); use "
                   "--accel bvh, or --backend cpu";
        case FrameFeature::spheres:
            return "spheres light luxels on the processor only (this backend keeps its luxels to "
                   "itself); use --backend cpu or leave --vsl out";
        case FrameFeature::pick_error:
            return "the error of picks is estimated on the processor only (kernels of this backend "
                   "keep no pick); use --backend cpu or leave the layer pick_error out";
        case FrameFeature::lobes:
            break;
    }
    return "VPLs keep the lobes of their surfaces on the processor only (kernels of this backend "
           "read none); use --backend cpu or leave --glossy out";
}

/// What frames throw that are asked for a feature which they lack.
[[nodiscard]] inline Error without(FrameFeature feature) {
    return {ErrorCode::unsupported, reason_without(feature)};
}

/// Why frames with these features cannot render such settings: reason_without(), empty where they
/// can.
[[nodiscard]] inline std::string reason_against(const RenderSettings& s, FrameFeatures features) {
    const bool by_vpls = s.integrator == Integrator::vpl;
    const std::pair<FrameFeature, bool> wanted[] = {
        {FrameFeature::embree, s.acceleration == Acceleration::embree},
        {FrameFeature::spheres, by_vpls && s.vsl.enabled},
        {FrameFeature::lobes, by_vpls && s.glossy.enabled},
        {FrameFeature::pick_error, by_vpls && s.pick_error_layer}};
    for (const auto& [feature, is_wanted] : wanted)
        if (is_wanted && !features.has(feature)) return reason_without(feature);
    return "";
}

/// The settings with LightSum::automatic decided.
[[nodiscard]] inline RenderSettings with_light_sum(RenderSettings s) {
    if (s.sum == LightSum::automatic) s.sum = s.wants_cuts() ? LightSum::cuts : LightSum::all;
    return s;
}

}  // namespace mir
