// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/chain_health.hpp"
#include "mir/metropolis/metropolis_tuning.hpp"
#include "mir/metropolis/multiple_try.hpp"
#include "mir/metropolis/path_mutation.hpp"
#include "mir/metropolis/primary_sample.hpp"

namespace mir {

/// What the acceptance of a mutation is made of.
struct ChainRules {
    /// Probability of taking the vertices of a gap out and putting `n` others in.
    MIR_HD static double choice(const GapChoices& gaps, std::uint32_t k, PathGap out,
                                std::uint32_t n) {
        return gaps.gap_probability(k, out) * gaps.count_probability(k, out, n);
    }
    /// Density of the `n` vertices after x_left of a path of k edges.
    MIR_HD static double refill(const PathMeasure& m, std::uint32_t k, std::uint32_t left,
                                std::uint32_t n) {
        return refill_density(m, k, left, n);
    }
    /// Whether a proposal is taken, for a number uniform in [0, 1).
    MIR_HD static bool accepts(double number, double probability) { return number < probability; }
};

/// Where a Markov chain stands and what it has been through. All that a PathChain remembers, 17 kB.
struct ChainState {
    /// Coordinates of the current path; under Mutation::bidirectional of its last large step.
    PrimarySample sample;
    WeightedPath paths[2];              ///< the current one and room for a proposal
    std::uint32_t current = 0;          ///< which of them is the current one
    double candidates[max_tries] = {};  ///< weights of a large step's tries
    WeightMoments large_weights;        ///< of all tries of large steps, accepted or not
    ChainHealth health;                 ///< counts of this chain
    std::uint32_t step = 0;             ///< mutations since the start; names their random numbers
    std::uint64_t stay = 0;             ///< mutations rejected since the last that was not
    bool is_broken = false;             ///< a number of an acceptance was none, on a device
};

/// A Markov chain of full paths whose stationary density is Y(F). The paths that matter to the
/// image, each as often as it brings light. Over the paths of another generator it is their target;
/// without a camera there are no bidirectional mutations. One thread at a time. Generator, options
/// and state must outlive it. Source: algorithm 1 of Pajot, Barthe, Paulin 2009; Metropolis light
/// transport (Veach and Guibas 1997).
template <class World, class Rules = ChainRules, class Generator = PathGenerator<World>>
class PathChain {
    static_assert(path_dimension::count <= max_coordinates);

 public:
    /// Chain number `chain` of a run where `state` stands. After start(), or where a PathChain of
    /// the same arguments has left it.
    MIR_HD PathChain(const Generator& generator, const ChainOptions& options, std::uint64_t seed,
                     std::uint32_t chain, ChainState& state)
        : generator_(generator),
          options_(options),
          gaps_(generator.techniques().min_edges(), generator.techniques().max_edges()),
          seed_(seed),
          chain_(chain),
          state_(state) {}

    /// The same, started.
    MIR_HD PathChain(const Generator& generator, const ChainOptions& options, std::uint64_t seed,
                     std::uint32_t chain, LargeStep first, ChainState& state)
        : PathChain(generator, options, seed, chain, state) {
        start(first);
    }

    /// Begins at a path of the bootstrap that carries light. Of what the state was before nothing
    /// is read.
    MIR_HD void start(LargeStep first) {
        state_.sample.start(seed_, chain_, first);
        state_.current = state_.step = 0;
        state_.large_weights = {};
        state_.health = {};
        state_.stay = 0;
        state_.is_broken = false;
        generator_.generate(state_.sample.propose_large(first), state_.paths[0]);
    }

    /// One mutation: the state moves or stays.
    MIR_HD void step() {
        ChainHealth& health = state_.health;
        const Random numbers = step_numbers(seed_, chain_, ++state_.step);
        const bool large = static_cast<double>(numbers.at(kind)) < options_.large_step_probability;
        bool moved = false;
        if (large)
            health.large.add(moved = large_move(numbers));
        else if (options_.mutation == Mutation::primary)
            health.small.add(moved = small_move(numbers));
        else if constexpr (Generator::has_camera)
            health.bidirectional.add(moved = bidirectional_move(numbers));
        state_.stay = moved ? 0 : state_.stay + 1;
        if (state_.stay > health.longest_stay) health.longest_stay = state_.stay;
        ++health.mutations;
    }

    /// The path where the chain stands. Valid until step() or start().
    [[nodiscard]] MIR_HD const WeightedPath& current() const {
        return state_.paths[state_.current];
    }
    /// Mutations since the start.
    [[nodiscard]] MIR_HD std::uint32_t steps() const { return state_.step; }
    /// Counts of this chain alone; summaries over chains are left at zero.
    [[nodiscard]] MIR_HD const ChainHealth& health() const { return state_.health; }
    /// Weights of all candidates of large steps, independent draws whose mean is P_c.
    [[nodiscard]] MIR_HD const WeightMoments& large_step_weights() const {
        return state_.large_weights;
    }
    /// True when on a device an acceptance had a negative or infinite number. The host throws
    /// there.
    [[nodiscard]] MIR_HD bool is_broken() const { return state_.is_broken; }

 private:
    /// Numbers of a step's decisions; those of its directions follow.
    enum Decision : std::uint32_t { kind, choice, acceptance_number, gap, count, split };
    static_assert(split < step_decisions);

    struct Directions {
        Random numbers;
        [[nodiscard]] MIR_HD float at(std::uint32_t d) const {
            return numbers.at(step_decisions + d);
        }
    };

    [[nodiscard]] MIR_HD WeightedPath& proposal() { return state_.paths[1 - state_.current]; }
    MIR_HD void move() { state_.current = 1 - state_.current; }

    MIR_HD bool large_move(const Random& numbers) {
        for (std::uint32_t j = 0; j < options_.tries; ++j) {
            propose_large(j);
            state_.candidates[j] = proposal().weight;
        }
        for (std::uint32_t j = 0; j < options_.tries; ++j)
            state_.large_weights.add(state_.candidates[j]);
        const MultipleTry t = multiple_try(current().weight, state_.candidates, options_.tries,
                                           static_cast<double>(numbers.at(choice)),
                                           static_cast<double>(numbers.at(acceptance_number)));
        note(t.acceptance);
        if (!t.accepted) return false;
        // Made a second time: keeping all of them would take a path's memory for each.
        if (t.chosen + 1 != options_.tries) propose_large(t.chosen);
        move();
        state_.sample.accept_large(large_step(chain_, state_.step, t.chosen));
        return true;
    }

    MIR_HD void propose_large(std::uint32_t attempt) {
        const LargeStep step = large_step(chain_, state_.step, attempt);
        generator_.generate(NearbyNumbers(state_.sample.propose_large(step)), proposal());
    }

    MIR_HD bool small_move(const Random& numbers) {
        generator_.generate(state_.sample.propose_small(state_.step), proposal());
        if (!accepts(numbers, acceptance(current().weight, proposal().weight))) return false;
        move();
        state_.sample.accept_small(state_.step);
        return true;
    }

    MIR_HD bool bidirectional_move(const Random& numbers) {
        const WeightedPath& x = current();
        WeightedPath& y = proposal();
        const std::uint32_t k = x.path.edges();
        const PathGap out = gaps_.sample_gap(k, static_cast<double>(numbers.at(gap)));
        const std::uint32_t n = gaps_.sample_count(k, out, static_cast<double>(numbers.at(count)));
        const std::uint32_t fewest = GapChoices::min_from_eye(out);
        const auto options = static_cast<float>(n - fewest + 1);
        const auto from_eye = fewest + static_cast<std::uint32_t>(numbers.at(split) * options);
        Directions u{numbers};
        if (!refill(generator_.world(), u, x.path, out, n, from_eye, y.path)) return false;
        y.path.spread = spread_at(u);
        weigh(generator_.world(), y, [&](const PathMeasure& m) {
            return mixture_density(m, y.path.edges(), generator_.techniques());
        });
        if (!(y.weight > 0.0) || !accepts(numbers, bidirectional_acceptance(x, y, out, n)))
            return false;
        move();
        return true;
    }

    [[nodiscard]] MIR_HD double bidirectional_acceptance(const WeightedPath& x,
                                                         const WeightedPath& y, PathGap out,
                                                         std::uint32_t n) const {
        const PathGap back{out.left, out.left + n + 1};
        const auto density = [&](const WeightedPath& from, PathGap hole, const WeightedPath& to,
                                 std::uint32_t added) {
            const std::uint32_t k = from.path.edges();
            return Rules::choice(gaps_, k, hole, added) *
                   Rules::refill(to.measure, to.path.edges(), hole.left, added);
        };
        const double there = density(x, out, y, n);
        if (!(there > 0.0)) return 0.0;
        return acceptance(luminance(x.measure.contribution), there,
                          luminance(y.measure.contribution), density(y, back, x, out.vertices()));
    }

    MIR_HD bool accepts(const Random& numbers, double probability) {
        note(probability);
        return Rules::accepts(static_cast<double>(numbers.at(acceptance_number)), probability);
    }
    MIR_HD void note(double probability) {
        state_.is_broken = state_.is_broken || !is_finite(probability);
    }

    const Generator& generator_;
    const ChainOptions& options_;
    GapChoices gaps_;
    std::uint64_t seed_;
    std::uint32_t chain_;
    ChainState& state_;
};

}  // namespace mir
