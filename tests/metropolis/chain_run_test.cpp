// SPDX-License-Identifier: MIT
#include "mir/metropolis/chain_run.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

// What run_chains() makes of what a machine brings home, over a machine without paths.

namespace {

using mir::ChainRun;
using mir::MetropolisOptions;

struct Lights {
    [[nodiscard]] double power() const { return 6.0; }
    [[nodiscard]] bool empty() const { return false; }
};

/// Every path weighs 2, or one in `rarity` as many times more and the others nothing; chain i
/// brings one record of bounce i + 2.
struct Machine {
    std::uint32_t broken = ~0u;  ///< chain of which a number was none
    std::uint64_t rarity = 1;

    void draw(std::uint64_t first, std::span<double> weights,
              std::span<std::uint32_t> places) const {
        for (std::size_t i = 0; i < weights.size(); ++i)
            weights[i] = (first + i) % rarity == 0 ? 2.0 * static_cast<double>(rarity) : 0.0;
        std::fill(places.begin(), places.end(), 0u);
    }
    [[nodiscard]] std::vector<ChainRun> walk(const std::vector<std::uint32_t>& starts) const {
        std::vector<ChainRun> runs(starts.size());
        for (std::size_t i = 0; i < runs.size(); ++i) {
            runs[i].records.resize(1);
            runs[i].records[0].bounce = static_cast<std::uint8_t>(i + 2);
            runs[i].tally.health.recorded_states = 1;
            runs[i].tally.is_broken = i == broken;
        }
        return runs;
    }
};

MetropolisOptions three_chains() {
    MetropolisOptions options;
    options.states = options.chains = 3;
    options.bootstrap = {1.0, 8, 8};
    return options;
}

}  // namespace

TEST_CASE("Records come chain after chain") {
    Machine machine;
    const mir::VplRecords found = run_chains(Lights{}, three_chains(), machine);
    REQUIRE(found.records.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK(found.records[i].bounce == i + 2);
    CHECK(found.path_luminance == 2.0);
    CHECK(found.states == 3.0);
    CHECK(found.emitted_power == 6.0f);
    CHECK(found.health->chains == 3);
}

TEST_CASE("A chain that broke on a device, where nothing throws, ends the run in words") {
    Machine machine;
    machine.broken = GENERATE(0u, 2u);
    try {
        static_cast<void>(run_chains(Lights{}, three_chains(), machine));
        FAIL("records of a broken chain came out");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::internal);
        CHECK(std::string(e.what()).find("report the scene") != std::string::npos);
    }
}

// The relative error of a mean of n weights, of which one in r is not zero, is sqrt((r - 1) / n).

TEST_CASE("There are as many chains as VPLs while the bootstrap knows their light well enough") {
    Machine machine;
    machine.rarity = 4;
    MetropolisOptions options;
    options.states = 1000;
    options.bootstrap.max_paths = 1u << 20;  // 9300 suffice for sqrt(0.33 / 1000)
    CHECK(run_chains(Lights{}, options, machine).health->chains == 1000);
}

TEST_CASE("Where the bootstrap ends too soon there are as many chains as it deserves") {
    Machine machine;
    machine.rarity = 17;
    MetropolisOptions options;
    options.states = 4000;
    options.bootstrap.max_paths = 1u << 15;
    // sqrt(16 / 32768): 0.33 / error^2 = 675
    const std::uint32_t chains = run_chains(Lights{}, options, machine).health->chains;
    CHECK(chains >= 670);
    CHECK(chains <= 680);
    // Few paths deserve less, but no run hangs on a handful of chains.
    machine.rarity = 4096;
    CHECK(run_chains(Lights{}, options, machine).health->chains == 256);
    // Who asks for an error gets the chains that were asked for.
    options.bootstrap.relative_error = 1.0;
    CHECK(run_chains(Lights{}, options, machine).health->chains == 4000);
}
