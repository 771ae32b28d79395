// SPDX-License-Identifier: MIT
#include "mir/sampling/metropolis_sampler.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/path_lab.hpp"

#include <cmath>

using mir::Lambert;
using mirtest::PathLab;

// H0: in the furnace the last of four refreshed suffixes of a state has P(b) ~ rho^b, b the
// scattering events of its path, as the state itself has. Chi-square over 20 000 chains of one
// state each, 1 % over both; seed 720.
TEST_CASE("recorded suffixes are as long as the states they refresh", "[statistical]") {
    constexpr std::uint32_t last = 8;
    const PathLab<Lambert> lab(mir::builtin::furnace_box(0.8f, 1.0f));
    mir::MetropolisOptions o;
    o.states = o.chains = 20'000;
    o.suffix_refresh = 4;
    o.max_bounce = last;
    o.bootstrap = {1.0, 400'000, 400'000};
    o.seed = 720;
    mir::TbbExecutor executor;
    const auto records = mir::MetropolisSampler(lab.world(), o).sample(executor).records;
    REQUIRE(records.size() == 5u * o.states);
    std::vector<double> first(last + 1);
    std::vector<double> refreshed(last + 1);
    std::vector<double> expected(last + 1);
    double sum = 0.0;
    for (std::uint32_t b = 2; b <= last; ++b) sum += expected[b] = std::pow(0.8, b);
    for (double& e : expected) e *= o.states / sum;
    for (std::size_t i = 0; i < records.size(); i += 5) {
        first[records[i].bounce] += 1.0;
        refreshed[records[i + 4].bounce] += 1.0;
    }
    CHECK(mirtest::chi_square(first, expected).p_value > mirtest::sidak(0.01, 2));
    CHECK(mirtest::chi_square(refreshed, expected).p_value > mirtest::sidak(0.01, 2));
}
