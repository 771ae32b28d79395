// SPDX-License-Identifier: MIT
#include "mir/metropolis/systematic_resampling.hpp"

#include "support/catch.hpp"

#include <limits>
#include <numeric>
#include <vector>

using Indices = std::vector<std::uint32_t>;

namespace {

using Weights = std::vector<double>;

/// Mean over all u of how often draw `c` of `count` is index i, minus w_i / sum(w), largest in
/// magnitude. Weights must be whole numbers: then draws change only at multiples of 1 / (count
/// sum), and midpoints between those stand for all u, without error.
template <class Resample>
double bias_of_draw(const Resample& resample, const Weights& weights, std::uint32_t count,
                    std::uint32_t c) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const int cells = static_cast<int>(sum) * static_cast<int>(count);
    Weights share(weights.size());
    for (int k = 0; k < cells; ++k)
        share[resample(weights, count, (k + 0.5) / cells)[c]] += 1.0 / cells;
    double worst = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i)
        worst = std::max(worst, std::fabs(share[i] - weights[i] / sum));
    return worst;
}

/// The usual layout: draw c in the c-th of `count` equal pieces.
Indices stratified_from_zero(const Weights& weights, std::uint32_t count, double u) {
    return mir::systematic_resampling(weights, count, u / count);
}

Indices library(const Weights& weights, std::uint32_t count, double u) {
    return mir::systematic_resampling(weights, count, u);
}

/// Multiplicities rounded to the nearest whole number: no randomness, no zero mean error.
Indices rounded(const Weights& weights, std::uint32_t count, double) {
    return mir::systematic_resampling(weights, count, 0.5 / count);
}

const Weights several{1, 0, 2, 5, 3, 0};

}  // namespace

TEST_CASE("every draw has the probabilities of the weights, exactly") {
    for (std::uint32_t count : {1u, 2u, 3u, 7u, 16u})
        for (std::uint32_t c = 0; c < count; ++c) {
            CAPTURE(count, c);
            CHECK(bias_of_draw(library, several, count, c) < 1e-12);
            CHECK(bias_of_draw(library, {1, 100, 1, 3}, count, c) < 1e-12);
        }
}

TEST_CASE("draws that are not uniform over the weights are rejected") {
    CHECK(bias_of_draw(stratified_from_zero, several, 3, 0) > 0.1);
    CHECK(bias_of_draw(rounded, several, 3, 0) > 0.1);
}

TEST_CASE("an index is drawn as often as its share says, give or take less than one") {
    const double sum = std::accumulate(several.begin(), several.end(), 0.0);
    for (std::uint32_t count : {1u, 5u, 32u})
        for (int k = 0; k < 1000; ++k) {
            Weights times(several.size());
            for (std::uint32_t i : library(several, count, (k + 0.5) / 1000)) times[i] += 1;
            for (std::size_t i = 0; i < several.size(); ++i)
                REQUIRE(std::fabs(times[i] - count * several[i] / sum) < 1.0);
        }
}

TEST_CASE("known draws") {
    CHECK(library({1, 1, 1, 1}, 4, 0.1) == Indices{0, 1, 2, 3});
    CHECK(library({1, 1, 1, 1}, 4, 0.6) == Indices{2, 3, 0, 1});
    CHECK(library({1, 3}, 4, 0.3) == Indices{1, 1, 1, 0});
    CHECK(library({1, 3}, 0, 0.3).empty());
}

TEST_CASE("indices without weight are never drawn, at either end") {
    for (double u : {0.0, 0.5, 1 - 0x1p-53})
        for (std::uint32_t i : library({0, 0.1, 0, 0.1, 0.1, 0, 0}, 5, u))
            CHECK((i == 1 || i == 3 || i == 4));
    const double smallest = std::numeric_limits<double>::denorm_min();
    CHECK(library({0, smallest, 0}, 1, 0.9) == Indices{1});  // the position rounds up to the sum
}

TEST_CASE("a fine uniform number has 48 bits and stays below 1") {
    const float almost_one = 0x1.fffffep-1f;
    CHECK(mir::fine_uniform(0.0f, 0.0f) == 0.0);
    CHECK(mir::fine_uniform(0.5f, 0.5f) == 0.5 + 0x1p-25);
    CHECK(mir::fine_uniform(almost_one, almost_one) == 1.0 - 0x1p-48);
}

TEST_CASE("weights that allow no choice are refused") {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Weights& bad : {Weights{}, {0, 0}, {1, -1}, {1, nan}, {infinity}, {1e308, 1e308}})
        CHECK_THROWS_AS(library(bad, 3, 0.5), mir::Error);
}
