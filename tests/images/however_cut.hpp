// SPDX-License-Identifier: MIT
#pragma once

#include "support.hpp"
#include "support/catch.hpp"

namespace mirtest {

/// Checks that threads, tiles, scheduler and the room for visibility change no bit of the indirect
/// light of a picture of 40 x 24 pixels, which has some.
inline void check_light_however_cut(const mir::Scene& scene, mir::RenderSettings s) {
    s.image = {40, 24};
    s.vpls = 64;
    s.threads = 1;
    const mir::RenderResult reference = render(scene, s);
    CHECK(mean_luminance(reference.indirect) > 0.0);
    for (const std::uint32_t tile : {16u, 48u})
        for (const char* scheduler : {"cpu", "cpu-blocks"}) {
            mir::RenderSettings other = s;
            other.threads = 2;
            other.tile = mir::Extent{tile, 16};
            other.scheduler = scheduler;
            if (tile == 16) other.limits.visibility_bytes = 8 * 1024;
            CAPTURE(int(s.sampler), tile, scheduler);
            CHECK(same_bits(render(scene, other).indirect, reference.indirect));
        }
}

}  // namespace mirtest
