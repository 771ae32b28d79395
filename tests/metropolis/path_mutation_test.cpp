// SPDX-License-Identifier: MIT
#include "mir/metropolis/path_mutation.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace {

using mir::GapChoices;
using mir::PathGap;

/// Calls f(gap) for every gap of a path of k edges, those that cannot be chosen included.
template <class F>
void for_each_gap(std::uint32_t k, const F& f) {
    for (std::uint32_t left = 0; left <= k; ++left)
        for (std::uint32_t right = left + 1; right <= k + 1; ++right) f(PathGap{left, right});
}

using Range = std::pair<std::uint32_t, std::uint32_t>;
const std::vector<Range> ranges{{2, 8}, {3, 8}, {2, 2}, {3, 3}, {2, 3}, {3, 33}, {2, 64}};

/// Calls f(choices, k) for all ranges and lengths up to 8.
template <class F>
void for_each_length(const F& f) {
    for (const auto& [min, max] : ranges)
        for (std::uint32_t k = min; k <= std::min(max, 8u); ++k) {
            CAPTURE(min, max, k);
            f(GapChoices(min, max), k, min, max);
        }
}

}  // namespace

TEST_CASE("the probabilities of all gaps of a path add up to one") {
    for_each_length([](const GapChoices& c, std::uint32_t k, std::uint32_t, std::uint32_t) {
        double sum = 0.0;
        for_each_gap(k, [&](PathGap g) { sum += c.gap_probability(k, g); });
        CHECK(sum == mirtest::Approx(1.0).epsilon(1e-12));
    });
}

TEST_CASE("the probabilities of all counts add up to one, and none leaves the range") {
    for_each_length([](const GapChoices& c, std::uint32_t k, std::uint32_t min, std::uint32_t max) {
        for_each_gap(k, [&](PathGap g) {
            if (c.gap_probability(k, g) == 0.0) return;
            double sum = 0.0;
            for (std::uint32_t n = 0; n <= max + 8; ++n) {
                const double p = c.count_probability(k, g, n);
                const std::uint32_t edges = k - g.vertices() + n;
                if (edges < min || edges > max || n < GapChoices::min_from_eye(g))
                    REQUIRE(p == 0.0);
                sum += p;
            }
            REQUIRE(sum == mirtest::Approx(1.0).epsilon(1e-12));
        });
    });
}

TEST_CASE("every mutation that is possible is possible the other way round") {
    std::uint64_t moves = 0;
    for_each_length([&](const GapChoices& c, std::uint32_t k, std::uint32_t, std::uint32_t max) {
        for_each_gap(k, [&](PathGap g) {
            if (c.gap_probability(k, g) == 0.0) return;
            for (std::uint32_t n = 0; n <= max; ++n) {
                if (c.count_probability(k, g, n) == 0.0) continue;
                const std::uint32_t other = k - g.vertices() + n;
                const PathGap back{g.left, g.left + n + 1};
                REQUIRE(c.gap_probability(other, back) > 0.0);
                REQUIRE(c.count_probability(other, back, g.vertices()) > 0.0);
                ++moves;
            }
        });
    });
    CHECK(moves > 1000);
}

TEST_CASE("every length of the range is reached from every other") {
    const GapChoices c(3, 8);
    for (std::uint32_t k = 3; k <= 8; ++k)
        for (std::uint32_t other = 3; other <= 8; ++other) {
            double p = 0.0;
            for_each_gap(k, [&](PathGap g) {
                const std::uint32_t stay = k - g.vertices();
                if (c.gap_probability(k, g) > 0.0 && stay <= other)
                    p += c.gap_probability(k, g) * c.count_probability(k, g, other - stay);
            });
            CAPTURE(k, other);
            CHECK(p > 0.0);
        }
}

TEST_CASE("gaps that move the first hit alone are rare, because the VPL stays") {
    const GapChoices c(3, 12);
    for (std::uint32_t k = 3; k <= 12; ++k) CHECK(c.gap_probability(k, {0, 2}) <= 0.1);
}

TEST_CASE("a gap is half as likely with each vertex more or less than one") {
    const GapChoices c(2, 8);
    const double one = c.gap_probability(5, {1, 3});
    CHECK(c.gap_probability(5, {1, 2}) == Approx(one / 2));
    CHECK(c.gap_probability(5, {1, 4}) == Approx(one / 2));
    CHECK(c.gap_probability(5, {1, 5}) == Approx(one / 4));
    CHECK(c.gap_probability(5, {0, 3}) == Approx(one / 2));
    CHECK(c.gap_probability(5, {4, 6}) == Approx(one));
    CHECK(c.gap_probability(5, {0, 2}) == Approx(one / 4));
}

TEST_CASE("a count is half as likely with each vertex more or less than were taken out") {
    const GapChoices c(2, 8);
    const double two = c.count_probability(5, {1, 4}, 2);
    for (const auto& [n, share] : {std::pair{0u, 4}, {1u, 2}, {3u, 2}, {4u, 4}, {5u, 8}})
        CHECK(c.count_probability(5, {1, 4}, n) == Approx(two / share));
    CHECK(c.count_probability(5, {1, 4}, 6) == 0.0);
}

namespace {

/// p-value of "gaps and counts are drawn as their probabilities, with `bias` to the gaps', say".
double p_of_sampling(const GapChoices& c, std::uint32_t k, std::uint32_t max, double bias) {
    constexpr std::uint64_t draws = 20'000;
    const std::size_t counts = max + 1;
    std::vector<double> expected;
    for_each_gap(k, [&](PathGap g) {
        const double p = c.gap_probability(k, g) * (g.right == k + 1 ? 1.0 + bias : 1.0);
        for (std::uint32_t n = 0; n < counts; ++n)
            expected.push_back(p > 0.0 ? p * c.count_probability(k, g, n) : 0.0);
    });
    double sum = 0.0;
    for (double e : expected) sum += e;
    for (double& e : expected) e *= static_cast<double>(draws) / sum;
    std::vector<double> observed(expected.size());
    for (std::uint64_t i = 0; i < draws; ++i) {
        const mir::Random u(40 + k, mir::Stream::test, i);
        const PathGap drawn = c.sample_gap(k, static_cast<double>(u.at(0)));
        const std::uint32_t n = c.sample_count(k, drawn, static_cast<double>(u.at(1)));
        std::size_t cell = n;
        for_each_gap(k, [&](PathGap g) {
            if (std::pair(g.left, g.right) < std::pair(drawn.left, drawn.right)) cell += counts;
        });
        observed[cell] += 1.0;
    }
    return mirtest::chi_square(observed, expected).p_value;
}

}  // namespace

// H0: gaps and counts follow their probabilities. Chi-square over 20 000 draws, 1 % over 14 ranges
// and lengths; seeds 40 + k.
TEST_CASE("gaps and counts are drawn with their probabilities", "[statistical]") {
    const auto [min, max] = GENERATE(Range{2, 8}, Range{3, 10});
    for (std::uint32_t k = 2; k <= 8; ++k) {
        if (k < min) continue;
        CAPTURE(min, max, k);
        CHECK(p_of_sampling(GapChoices(min, max), k, max, 0.0) > mirtest::sidak(0.01, 13));
    }
    CHECK(p_of_sampling(GapChoices(min, max), 5, max, 0.2) < 1e-4);
}

TEST_CASE("the ends of the unit interval choose something possible") {
    for_each_length([](const GapChoices& c, std::uint32_t k, std::uint32_t, std::uint32_t) {
        for (double u : {0.0, 1.0 - 0x1p-24}) {
            const PathGap g = c.sample_gap(k, u);
            REQUIRE(c.gap_probability(k, g) > 0.0);
            for (double v : {0.0, 1.0 - 0x1p-24})
                REQUIRE(c.count_probability(k, g, c.sample_count(k, g, v)) > 0.0);
        }
    });
}

TEST_CASE("new vertices have the mean density of all ways to share them between camera and light") {
    mir::PathMeasure m;  // primes, so that no two products are equal
    m.from_eye[2] = 2;
    m.from_eye[3] = 3;
    m.from_eye[4] = 5;
    m.from_light[1] = 7;
    m.from_light[2] = 11;
    m.from_light[3] = 13;
    m.next_event = 17;
    m.emission = 19;
    using mirtest::Approx;
    CHECK(refill_density(m, 4, 1, 2) == Approx((11 * 13 + 2 * 13 + 2 * 3) / 3.0));
    CHECK(refill_density(m, 4, 2, 2) == Approx((13 * 19 + 3 * 17 + 3 * 5) / 3.0));
    // x1 is what the film shows: it comes from the camera, and its density is left out.
    CHECK(refill_density(m, 4, 0, 2) == Approx((11 + 2) / 2.0));
}
