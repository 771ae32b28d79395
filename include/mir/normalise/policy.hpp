// SPDX-License-Identifier: MIT
#pragma once

namespace mir {

/// How intensities are made of the radiance R that a sampler recorded (docs/method.md, 10).
enum class NormalisationPolicy {
    full,      ///< response over all luxels of the image: equal flux to the camera, exactly
    prepass,   ///< response over a few luxels where enough of them are lit, else over all
    proposal,  ///< the sampler normalises by a target it knows; records are final
    none       ///< records stay as they are
};

/// Name of a policy, as in options and results.
constexpr const char* to_string(NormalisationPolicy policy) {
    switch (policy) {
        case NormalisationPolicy::full:
            return "full";
        case NormalisationPolicy::prepass:
            return "prepass";
        case NormalisationPolicy::proposal:
            return "proposal";
        case NormalisationPolicy::none:
            break;
    }
    return "none";
}

}  // namespace mir
