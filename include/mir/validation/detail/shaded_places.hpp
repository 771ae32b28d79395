// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/double3.hpp"
#include "mir/core/frame.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/vpl.hpp"
#include "mir/validation/detail/random.hpp"
#include "mir/validation/detail/same_pixels.hpp"
#include "mir/validation/detail/worse.hpp"

#include <algorithm>
#include <cmath>

namespace mir::validation::detail {

/// A luxel, what is known of its surface, and a VPL.
struct ShadedPlace {
    Hit hit;
    Vec3 normal{0};  ///< unit shading normal
    Vec3 wo{0};      ///< unit direction towards the viewer
    Vpl vpl;

    /// From luxel to VPL.
    [[nodiscard]] mir::detail::Double3 segment() const {
        return mir::detail::Double3(vpl.position) - mir::detail::Double3(hit.position);
    }
    [[nodiscard]] double distance_squared() const { return glm::dot(segment(), segment()); }
    [[nodiscard]] Vec3 wi() const { return {glm::normalize(segment())}; }
    /// Negative below the horizon of the shading normal.
    [[nodiscard]] double cos_luxel() const {
        return glm::dot(glm::normalize(segment()), mir::detail::Double3(normal));
    }
    /// Negative behind the VPL.
    [[nodiscard]] double cos_vpl() const {
        return -glm::dot(glm::normalize(segment()), mir::detail::Double3(vpl.normal));
    }
    /// By more than single precision may not notice.
    [[nodiscard]] bool is_below_horizon() const { return cos_luxel() < -1e-6 || cos_vpl() < -1e-6; }
};

/// Luxel and VPL on all sides of each other, 0.1 mm to 1 km apart.
inline ShadedPlace random_shaded_place(Random& random) {
    ShadedPlace at;
    at.hit = {{0.1f, 0.2f, -0.3f}, direction(random)};
    at.normal = direction(random);
    at.wo = Frame::around(at.normal).to_world(square_to_cosine_hemisphere(random.next_2d()));
    const float distance = std::pow(10.0f, 7.0f * random.next() - 4.0f);
    at.vpl.position = at.hit.position + distance * direction(random);
    at.vpl.normal = direction(random);
    at.vpl.intensity = {1.0f, 100.0f * random.next(), 0.0f};
    return at;
}

/// Largest difference of a channel, of its larger value. 0 of equal ones, NaN of NaN.
inline double relative_difference(Rgb a, Rgb b) {
    double worst = 0.0;
    for (const auto& [x, y] : {std::pair{a.r, b.r}, {a.g, b.g}, {a.b, b.b}})
        if (x != y)
            worst = worse(worst, static_cast<double>(std::fabs(x - y)) /
                                     static_cast<double>(std::max(std::fabs(x), std::fabs(y))));
    return worst;
}

}  // namespace mir::validation::detail
