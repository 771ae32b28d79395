// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/result.hpp"
#include "support/catch.hpp"
#include "support/same_images.hpp"

namespace mirtest {

/// Checks that all images, VPLs and sums of two renders are equal in every bit.
inline void check_same(const mir::RenderResult& a, const mir::RenderResult& b) {
    CHECK(same_bits(a.beauty, b.beauty));
    CHECK(same_bits(a.emission, b.emission));
    CHECK(same_bits(a.direct, b.direct));
    CHECK(same_bits(a.indirect, b.indirect));
    CHECK(same_bits(a.removed, b.removed));
    CHECK(same_bits(a.coverage, b.coverage));
    CHECK(same_bits(a.pick_error, b.pick_error));
    REQUIRE(a.bounces.size() == b.bounces.size());
    for (std::size_t i = 0; i < a.bounces.size(); ++i) CHECK(same_bits(a.bounces[i], b.bounces[i]));
    CHECK(same_bits(a.guides.albedo, b.guides.albedo));
    CHECK(same_bits(a.guides.normal, b.guides.normal));
    CHECK(same_bits(a.guides.position, b.guides.position));
    CHECK(same_bits(a.guides.depth, b.guides.depth));
    REQUIRE(a.vpls.size() == b.vpls.size());
    for (std::size_t j = 0; j < a.vpls.size(); ++j) {
        CHECK(a.vpls.vpls()[j].position == b.vpls.vpls()[j].position);
        CHECK(a.vpls.vpls()[j].intensity == b.vpls.vpls()[j].intensity);
    }
    CHECK(a.statistics.bound == b.statistics.bound);
    CHECK(a.statistics.indirect_luminance == b.statistics.indirect_luminance);
    CHECK(a.statistics.removed_luminance == b.statistics.removed_luminance);
    CHECK(a.statistics.residual_luminance == b.statistics.residual_luminance);
}

}  // namespace mirtest
