// SPDX-License-Identifier: MIT
#include "mir/sampling/faint_splats.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"

#include <vector>

using mir::CausticSplat;
using mir::faint_share;
using mir::PathLuminance;

namespace {

constexpr std::uint64_t traced = 1u << 17;
constexpr std::uint64_t luxels = 100;
const PathLuminance indirect{2.0, 0.1, 1000, 500};

/// As many splats, each with this share of the indirect light where all paths are traced.
std::vector<CausticSplat> splats(std::size_t count, double share) {
    const auto l = static_cast<float>(share * indirect.mean * static_cast<double>(luxels));
    return std::vector<CausticSplat>(count, CausticSplat{0, 0, 1, {l, l, l}});
}

double limit(const std::vector<CausticSplat>& of, std::uint64_t paths = traced) {
    return faint_share(of, traced, paths, indirect, luxels).value();
}

}  // namespace

TEST_CASE("no splat of many paths is next to nothing, and not nothing") {
    // Two thirds of log(40) times ten usual paths, each of which brings 2 / 131072.
    CHECK(limit({}) == mirtest::Approx(2.0 / 3.0 * 3.688879 * 10.0 * 2.0 / 131072.0));
    CHECK(limit({}) < 1e-3);
    CHECK(faint_share({}, 1000, 1000, indirect, luxels).value() > 1e-3);
}

TEST_CASE("what is found counts for all paths, and bright splats for more to come") {
    CHECK(limit(splats(1000, 1e-6)) > 1e-3);
    CHECK(limit(splats(1000, 1e-6)) < 1.6e-3);
    CHECK(limit(splats(1, 1e-3)) > 4e-3);
    // Half of the paths: they stand for all.
    CHECK(limit(splats(1000, 1e-6), 2 * traced) > 2e-3);
}

TEST_CASE("without indirect light there is nothing to compare with") {
    CHECK_FALSE(faint_share({}, traced, traced, {0.0, 0.0, 1000, 0}, luxels));
}

// H0: the limit is too low in 2.5 % of cases at most. 400 times a hundred thousand paths of whom
// few bring an exponentially distributed light; seeds 0 to 399. More than 20 too low ones have
// probability below 0.1 %.
TEST_CASE("the limit holds for rare splats", "[statistical]") {
    const double chance = GENERATE(1e-5, 1e-4, 1e-3);
    const double mean = 2e-5;
    const double truth = chance * static_cast<double>(traced) * mean;
    int too_low = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        mir::Random random(seed, mir::Stream::test, 72);
        std::vector<CausticSplat> found;
        // Waiting times between splats.
        const auto wait = [&] { return -std::log1p(-static_cast<double>(random.next())); };
        for (double at = wait() / chance; at < static_cast<double>(traced); at += wait() / chance)
            found.push_back(splats(1, mean * wait()).front());
        too_low += limit(found) < truth ? 1 : 0;
    }
    CHECK(too_low <= 20);
}
