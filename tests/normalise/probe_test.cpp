// SPDX-License-Identifier: MIT
#include "mir/normalise/probe.hpp"

#include "support/catch.hpp"

TEST_CASE("VPLs that fewer than 64 probes see are poorly probed") {
    const std::vector<mir::ImageResponse> responses{
        {1, 1, 1, 64}, {1, 1, 1, 63}, {0, 0, 0, 0}, {1, 1, 1, 1000}};
    CHECK(mir::poorly_probed(responses) == std::vector<mir::VplIndex>{1, 2});
    CHECK(mir::poorly_probed({}).empty());
}
