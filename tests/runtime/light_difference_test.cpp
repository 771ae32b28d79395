// SPDX-License-Identifier: MIT
#include "mir/runtime/light_difference.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"

#include <vector>

using mir::light_difference;

TEST_CASE("a difference of light is relative to the truth, which is the mean of both estimates") {
    const std::vector<double> estimate{3.0, 1.0};
    const std::vector<double> first{1.0, 1.0};
    const std::vector<double> second{3.0, 3.0};
    const auto d = light_difference(estimate, first, second);
    CHECK(d.mean == 0.0);
    // Off by 1 at both places, over a sum of 4.
    CHECK(d.standard_error == Approx(std::sqrt(2.0 * 2.0) / 4.0));
    // (3 - 1) (3 - 3) + (1 - 1) (1 - 3) = 0: all of it may be noise.
    CHECK(d.spread == 0.0);
}

TEST_CASE("a difference that is the same everywhere is the mean and has no error") {
    const std::vector<double> truth{1.0, 2.0, 3.0};
    const auto d = light_difference(std::vector<double>{1.1, 2.2, 3.3}, truth, truth);
    CHECK(d.mean == Approx(0.1));
    CHECK(d.standard_error < 1e-15);
    CHECK(d.spread == Approx(0.1 * std::sqrt(14.0 / 3.0) / 2.0));
}

TEST_CASE("without light, or without places, there is no difference") {
    const std::vector<double> black{0.0, 0.0};
    for (const auto& d : {light_difference(black, black, black), light_difference({}, {}, {}),
                          light_difference(std::vector<double>{1.0, 1.0}, black, black)}) {
        CHECK(d.mean == 0.0);
        CHECK(d.standard_error == 0.0);
        CHECK(d.spread == 0.0);
    }
}

// Estimates of 1 at 4000 places, exact but for a bias of 5 %, against truths with uniform noise of
// standard deviation 0.29: the bias within 4 of its standard errors, and the square of the spread
// within 4 of the standard deviations, 0.0014, of a mean of products of such noise. Seeds 1 to 20.
TEST_CASE("the noise of what is known to be right is no spread", "[statistical]") {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        std::vector<double> estimate(4000, 1.05);
        std::vector<double> first;
        std::vector<double> second;
        mir::Random random(seed, mir::Stream::test, 0);
        for (std::size_t i = 0; i < estimate.size(); ++i) {
            first.push_back(0.5 + static_cast<double>(random.next()));
            second.push_back(0.5 + static_cast<double>(random.next()));
        }
        const auto d = light_difference(estimate, first, second);
        CAPTURE(seed, d.mean, d.standard_error, d.spread);
        CHECK(std::fabs(d.mean - 0.05) < 4.0 * d.standard_error);
        CHECK(d.standard_error == Approx(1.05 * 0.204 / std::sqrt(4000.0)).epsilon(0.1));
        CHECK(d.spread < std::sqrt(0.0025 + 4.0 * 0.0014));
    }
}
