// SPDX-License-Identifier: MIT
#include "mir/runtime/share_estimate.hpp"

#include "support/catch.hpp"

#include <vector>

using mir::share_estimate;

TEST_CASE("a share is that of the sums, not the mean of shares") {
    const auto e = share_estimate(std::vector<double>{1.0, 0.0}, std::vector<double>{1.0, 2.0});
    CHECK(e.share == 0.25);
    // Off by 0.5 at both places, over a sum of 4.
    CHECK(e.standard_error == Approx(1.0 / 4.0));
}

TEST_CASE("a share that is the same at each place has no error") {
    const auto e = share_estimate(std::vector<double>{1.0, 3.0, 0.0}, std::vector<double>{3, 9, 0});
    CHECK(e.share == 0.25);
    CHECK(e.standard_error == 0.0);
    CHECK(share_estimate(std::vector<double>{2.0, 1.0}, std::vector<double>{0.0, 0.0}).share ==
          1.0);
}

TEST_CASE("without light, or without places, a share is 0") {
    const std::vector<double> black{0.0, 0.0};
    for (const auto& e : {share_estimate(black, black), share_estimate({}, {})}) {
        CHECK(e.share == 0.0);
        CHECK(e.standard_error == 0.0);
    }
}
