// SPDX-License-Identifier: MIT
// A Metropolis chain with lazy coordinates on a target in closed form, whose states differ in the
// coordinates they look at, as paths of different lengths do.
#include "metropolis/faulty_sample.hpp"
#include "mir/metropolis/multiple_try.hpp"
#include "mir/metropolis/primary_sample.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <vector>

using mir::Stream;
using mirtest::Fault;
using mirtest::FaultySample;

namespace {

constexpr std::uint64_t seed = 51;

double ramp(double x) { return 0.2 + 1.6 * x; }
double hill(double x) { return 6.0 * x * (1.0 - x); }
double slit(double x) { return x >= 0.375 && x < 0.625 ? 4.0 : 0.0; }
constexpr double largest_contribution = 1.5 * 4.0;

/// What a point of primary sample space stands for. Coordinate 0 decides whether coordinate 1
/// alone or 1 and 3 matter; either branch holds half of the target, as each function integrates to
/// one.
struct State {
    bool second_branch;
    float x, y;
    double contribution;
};

template <class Numbers>
State evaluate(Numbers&& u) {
    State s{u.at(0) >= 0.5f, u.at(1), 0.0f, 0.0};
    if (s.second_branch) s.y = u.at(3);
    const double x = static_cast<double>(s.x), y = static_cast<double>(s.y);
    s.contribution = s.second_branch ? hill(x) * slit(y) : ramp(x);
    return s;
}

struct Settings {
    float large_share = 0.25f;
    std::uint32_t tries = 1;
    bool repeats = true;  // whether a rejected proposal records the old state once more
    mir::SmallStep kernel{0x1p-4f, 0.25f};
};

/// One chain, started in the target by rejection.
template <class Sample>
class Chain {
 public:
    Chain(const Settings& settings, std::uint32_t number)
        : settings_(settings),
          number_(number),
          sample_(seed, number, first(number), settings.kernel),
          state_(evaluate(sample_)) {}

    /// Evaluated anew, as a renderer does that stores how to find a path again.
    [[nodiscard]] State state() { return evaluate(sample_); }

    /// Returns whether the proposal was accepted.
    bool step() {
        const mir::Random numbers = mir::step_numbers(seed, number_, ++step_);
        return numbers.at(0) < settings_.large_share ? large_step(numbers) : small_step(numbers);
    }

 private:
    static mir::LargeStep first(std::uint32_t chain) {
        for (std::uint64_t i = std::uint64_t{chain} << 32;; ++i) {
            const State s = evaluate(mir::Random(seed, Stream::bootstrap, i));
            const float u = mir::Random(seed, Stream::seeding, i).at(0);
            if (static_cast<double>(u) * largest_contribution < s.contribution)
                return {Stream::bootstrap, i};
        }
    }

    bool small_step(const mir::Random& numbers) {
        const State proposal = evaluate(sample_.propose_small(step_));
        const double a = mir::acceptance(state_.contribution, proposal.contribution);
        if (static_cast<double>(numbers.at(1)) >= a) return false;
        sample_.accept_small(step_);
        state_ = proposal;
        return true;
    }

    bool large_step(const mir::Random& numbers) {
        std::vector<double> weights;
        for (std::uint32_t j = 0; j < settings_.tries; ++j)
            weights.push_back(proposed(j).contribution);
        const auto outcome =
            mir::multiple_try(state_.contribution, weights, static_cast<double>(numbers.at(2)),
                              static_cast<double>(numbers.at(1)));
        if (!outcome.accepted) return false;
        state_ = proposed(outcome.chosen);
        sample_.accept_large(mir::large_step(number_, step_, outcome.chosen));
        return true;
    }

    [[nodiscard]] State proposed(std::uint32_t attempt) const {
        return evaluate(sample_.propose_large(mir::large_step(number_, step_, attempt)));
    }

    Settings settings_;
    std::uint32_t number_;
    std::uint32_t step_ = 0;
    Sample sample_;
    State state_;
};

/// Cells of x in the first branch, of (x, y) in the second.
constexpr int columns = 8, rows = 8;

std::size_t cell(const State& s) {
    const int ix = static_cast<int>(s.x * columns);
    const int iy = static_cast<int>(s.y * rows);
    return static_cast<std::size_t>(s.second_branch ? columns + iy * columns + ix : ix);
}

std::vector<double> probabilities() {
    const auto first =
        mirtest::cell_integrals(columns, 1, 1, [](double x, double) { return ramp(x); });
    const auto second = mirtest::cell_integrals(
        columns, rows, 2, [](double x, double y) { return hill(x) * slit(y); });
    std::vector<double> p;
    for (double f : first) p.push_back(f / 2);
    for (double f : second) p.push_back(f / 2);
    return p;
}

/// p-value of "record number 64 of a chain follows the target", by one record from each of 10 000
/// independent chains: records of one chain are not independent, however thinned.
template <class Sample>
double target_p_value(const Settings& settings) {
    constexpr std::uint32_t chains = 10'000;
    constexpr int records = 64;
    std::vector<double> observed(probabilities().size());
    for (std::uint32_t c = 0; c < chains; ++c) {
        Chain<Sample> chain(settings, c);
        for (int record = 0; record < records;)
            if (chain.step() || settings.repeats) ++record;
        observed[cell(chain.state())] += 1;
    }
    std::vector<double> expected = probabilities();
    for (double& e : expected) e *= chains;
    return mirtest::chi_square(observed, expected).p_value;
}

Settings with(float large_share, std::uint32_t tries) {
    Settings s;
    s.large_share = large_share;
    s.tries = tries;
    return s;
}

}  // namespace

// H0: the state after 64 steps follows the target that the first state was drawn from. Pearson's
// chi-square over 72 cells, 1 % over 5 settings, seed 51.
TEST_CASE("chains with lazy coordinates stay in their target", "[statistical]") {
    const double level = mirtest::sidak(0.01, 5);
    CHECK(target_p_value<mir::PrimarySample>(with(0.0f, 1)) > level);
    CHECK(target_p_value<mir::PrimarySample>(with(0.25f, 1)) > level);
    CHECK(target_p_value<mir::PrimarySample>(with(0.5f, 4)) > level);
    CHECK(target_p_value<mir::PrimarySample>(with(1.0f, 4)) > level);
    Settings usual = with(0.5f, 4);
    usual.kernel = {};
    CHECK(target_p_value<mir::PrimarySample>(usual) > level);
}

// The same statistic; each fault is rejected at 1e-6.
TEST_CASE("chains with a fault leave their target", "[statistical]") {
    CHECK(target_p_value<FaultySample<Fault::stale_coordinate>>(with(0.0f, 1)) < 1e-6);
    CHECK(target_p_value<FaultySample<Fault::no_roll_back>>(with(0.25f, 1)) < 1e-6);
    CHECK(target_p_value<FaultySample<Fault::large_step_forgets>>(with(0.25f, 1)) < 1e-6);
    CHECK(target_p_value<FaultySample<Fault::one_way>>(with(0.0f, 1)) < 1e-6);
    Settings without_repeats = with(0.25f, 1);
    without_repeats.repeats = false;
    CHECK(target_p_value<mir::PrimarySample>(without_repeats) < 1e-6);
}
