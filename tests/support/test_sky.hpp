// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/environment.hpp"

namespace mirtest {

/// Twelve columns, six rows, no two alike, brighter above, with one texel that shines eighty times
/// as much as its neighbours and one that is black; turned and scaled, so that either would be
/// noticed. `low` makes the lower half black.
inline mir::Environment test_sky(bool low = true) {
    mir::Environment sky;
    sky.name = "test sky";
    sky.radiance = mir::Image<mir::Rgb>({12, 6});
    for (std::uint32_t y = 0; y < 6; ++y)
        for (std::uint32_t x = 0; x < 12; ++x) {
            const float up = static_cast<float>(6 - y) / 6.0f;
            const float around = static_cast<float>(x) / 12.0f;
            if (y < 3 || low)
                sky.radiance(x, y) = {up, 0.5f * up + 0.3f * around, 0.2f + 0.5f * around};
        }
    sky.radiance(4, 1) = {60, 50, 40};
    sky.radiance(9, 2) = {};
    sky.scale = 0.5f;
    sky.rotation = 200.0f;
    sky.light_group = 9;
    return sky;
}

/// The same radiance from everywhere.
inline mir::Environment constant_sky(mir::Rgb radiance) {
    mir::Environment sky;
    sky.radiance = mir::Image<mir::Rgb>({8, 4}, radiance);
    return sky;
}

}  // namespace mirtest
