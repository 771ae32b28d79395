// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <cstdint>
#include <string>

namespace mir {

/// Light from all around, infinitely far away, as an equirectangular image. The image gives the
/// radiance of each direction, W m^-2 sr^-1.
///
/// The top row looks up (+y), the bottom row down. Unrotated, the centre of the image lies in the
/// direction +x and columns to its right go towards +z, so that somebody inside who looks along +x
/// sees the image upright and not mirrored; its left and right edge meet at -x. A texel covers
/// equal steps of azimuth and of the angle from +y, and all directions in it have its radiance:
/// nothing is interpolated.
struct Environment {
    std::string name;       ///< for messages
    Image<Rgb> radiance;    ///< finite, not negative, W m^-2 sr^-1
    float scale = 1.0f;     ///< multiplies the radiance; finite, not negative
    float rotation = 0.0f;  ///< degrees about +y, counter-clockwise seen from above: 90 brings the
                            ///< centre of the image from +x to -z
    std::uint16_t light_group = 0;  ///< group that its light is counted in
};

}  // namespace mir
