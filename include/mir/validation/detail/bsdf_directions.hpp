// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"

#include <cmath>

namespace mir::validation::detail {

/// A unit normal that is not an axis, so that frames are exercised.
inline const Vec3 slanted_normal = glm::normalize(Vec3(0.3f, -0.5f, 0.8f));

/// Unit direction at cos(theta) from slanted_normal and azimuth phi.
inline Vec3 at_angle(float cos_theta, float phi) {
    const float s = std::sqrt(larger(0.0f, 1.0f - cos_theta * cos_theta));
    return Frame::around(slanted_normal)
        .to_world({s * std::cos(phi), s * std::sin(phi), cos_theta});
}

/// Cosines from normal to grazing incidence.
inline constexpr float usual_cosines[] = {1.0f, 0.999f, 0.9f, 0.7f, 0.4f, 0.15f, 0.03f};
/// The same, and beyond what any quadrature resolves.
inline constexpr float grazing_cosines[] = {1.0f, 0.7f, 0.1f, 1e-2f, 1e-4f, 1e-6f, 1e-9f, 0.0f};

}  // namespace mir::validation::detail
