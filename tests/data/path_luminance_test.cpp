// SPDX-License-Identifier: MIT
#include "mir/data/path_luminance.hpp"

#include "support/catch.hpp"

#include <vector>

using mir::path_luminance;
using mir::PathLuminance;
using mirtest::Approx;

TEST_CASE("mean and standard error of weights, those without light included") {
    const std::vector<double> weights{4, 0, 2, 0, 4};
    const PathLuminance p = path_luminance(weights);
    CHECK(p.paths == 5);
    CHECK(p.contributing == 3);
    CHECK(p.mean == Approx(2.0));
    CHECK(p.standard_error == Approx(std::sqrt(16.0 / 4 / 5)));
    CHECK(p.relative_error() == Approx(p.standard_error / 2));
    CHECK(p.high() - p.mean == Approx(1.96 * p.standard_error));
    CHECK(p.mean - p.low() == Approx(1.96 * p.standard_error));
}

TEST_CASE("no weights, one weight and weights without light are defined") {
    CHECK(path_luminance({}).mean == 0.0);
    CHECK(path_luminance({}).relative_error() == 0.0);
    const std::vector<double> one{3};
    CHECK(path_luminance(one).mean == 3.0);
    CHECK(path_luminance(one).standard_error == 0.0);
    const std::vector<double> dark(10);
    CHECK(path_luminance(dark).paths == 10);
    CHECK(path_luminance(dark).contributing == 0);
    CHECK(path_luminance(dark).relative_error() == 0.0);
}

TEST_CASE("equal weights have no spread, however many and large") {
    const std::vector<double> weights(1000, 1e200);
    CHECK(path_luminance(weights).mean == Approx(1e200));
    CHECK(path_luminance(std::vector<double>(64, 0.5)).standard_error == 0.0);
}

TEST_CASE("moments of parts add up to those of the whole, whatever their sizes") {
    const std::vector<double> weights{4, 0, 2, 0, 4, 7, 1};
    const PathLuminance whole = path_luminance(weights);
    for (std::size_t cut = 0; cut <= weights.size(); ++cut) {
        CAPTURE(cut);
        mir::WeightMoments parts[2];
        for (std::size_t i = 0; i < weights.size(); ++i) parts[i < cut ? 0 : 1].add(weights[i]);
        parts[0].add(parts[1]);
        const PathLuminance sum = parts[0].estimate();
        CHECK(sum.mean == Approx(whole.mean));
        CHECK(sum.standard_error == Approx(whole.standard_error));
        CHECK(sum.paths == whole.paths);
        CHECK(sum.contributing == whole.contributing);
    }
}
