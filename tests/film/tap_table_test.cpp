// SPDX-License-Identifier: MIT
#include "mir/film/tap_table.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

using mir::Filter;
using mir::LuxelGrid;
using mir::detail::TapTable;

TEST_CASE("tabulated weights are close to the filter and exact at the centre of the pixel") {
    const LuxelGrid grid = mir::luxel_grid({4, 4}, 9);
    std::vector<float> offsets{0.5f};
    for (int i = 0; i < 5000; ++i) offsets.push_back((static_cast<float>(i) + 0.5f) / 5000.0f);
    std::vector<double> weights(offsets.size());
    for (const mir::FilterName& entry : mir::filter_names) {
        const Filter filter = mir::default_filter(entry.kind);
        const TapTable table(grid, filter);
        INFO(mir::to_string(filter.kind) << " " << filter.half_width);
        double worst = 0.0;
        for (std::uint32_t tap = 0; tap < table.taps(); ++tap) {
            const float shift = static_cast<float>(table.reach()) - static_cast<float>(tap);
            table.weigh(tap, offsets, weights.data());
            CHECK(weights[0] == double{filter.along(shift)});
            for (std::size_t i = 0; i < offsets.size(); ++i)
                worst = std::max(
                    worst, std::fabs(weights[i] - double{filter.along(offsets[i] - 0.5f + shift)}));
        }
        CHECK(worst < 4e-7);
    }
}

TEST_CASE("taps that no luxel of a cell reaches are left out") {
    const TapTable even(mir::luxel_grid({4, 4}, 4), Filter{});
    REQUIRE(even.taps() == 7);
    CHECK(even.x(0).begin == 0);
    CHECK(even.x(0).end == 6);
    CHECK(even.y(1).begin == 1);
    CHECK(even.y(1).end == 7);
    const TapTable odd(mir::luxel_grid({4, 4}, 9), Filter{});
    CHECK(odd.x(1).begin == 0);
    CHECK(odd.x(1).end == 7);
    const TapTable centred(mir::luxel_grid({4, 4}, 1), Filter{});
    CHECK(centred.taps() == 1);
}
