// SPDX-License-Identifier: MIT
#include "mir/normalise/prepass.hpp"

#include "support/catch.hpp"

TEST_CASE("VPLs that light fewer than 64 luxels of a prepass are poorly measured") {
    const std::vector<mir::ImageResponse> responses{
        {1, 1, 1, 64}, {1, 1, 1, 63}, {0, 0, 0, 0}, {1, 1, 1, 1000}};
    CHECK(mir::poorly_measured(responses) == std::vector<mir::VplIndex>{1, 2});
    CHECK(mir::poorly_measured({}).empty());
}
