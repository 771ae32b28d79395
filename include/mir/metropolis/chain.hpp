// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/chain_health.hpp"
#include "mir/metropolis/chain_options.hpp"
#include "mir/metropolis/multiple_try.hpp"
#include "mir/metropolis/path_mutation.hpp"
#include "mir/metropolis/primary_sample.hpp"

namespace mir {

/// What the acceptance of a mutation is made of.
struct ChainRules {
    /// Probability of taking the vertices of a gap out and putting `n` others in.
    static double choice(const GapChoices& gaps, std::uint32_t k, PathGap out, std::uint32_t n) {
        return gaps.gap_probability(k, out) * gaps.count_probability(k, out, n);
    }
    /// Density of the `n` vertices after x_left of a path of k edges.
    static double refill(const PathMeasure& m, std::uint32_t k, std::uint32_t left,
                         std::uint32_t n) {
        return refill_density(m, k, left, n);
    }
    static bool accepts(double number, double probability) { return number < probability; }
};

/// A Markov chain of full paths whose stationary density is Y(F): the paths that matter to the
/// image, each as often as it brings light. Over the paths of another generator it is their target;
/// without a camera there are no bidirectional mutations. One thread at a time. Source: algorithm 1
/// of Pajot, Barthe, Paulin 2009; Metropolis light transport (Veach and Guibas 1997).
template <class World, class Rules = ChainRules, class Generator = PathGenerator<World>>
class PathChain {
 public:
    /// Chain number `chain` of a run, started from a path of the bootstrap that carries light.
    PathChain(const Generator& generator, const ChainOptions& options, std::uint64_t seed,
              std::uint32_t chain, LargeStep start)
        : generator_(generator),
          options_(options),
          gaps_(generator.techniques().min_edges(), generator.techniques().max_edges()),
          seed_(seed),
          chain_(chain),
          sample_(seed, chain, start),
          candidates_(options.tries),
          weights_(options.tries) {
        generator.generate(sample_.propose_large(start), current_);
    }

    /// One mutation: the state moves or stays.
    void step() {
        const Random numbers = step_numbers(seed_, chain_, ++step_);
        const bool large = static_cast<double>(numbers.at(kind)) < options_.large_step_probability;
        bool moved = false;
        if (large)
            health_.large.add(moved = large_move(numbers));
        else if (options_.mutation == Mutation::primary)
            health_.small.add(moved = small_move(numbers));
        else if constexpr (Generator::has_camera)
            health_.bidirectional.add(moved = bidirectional_move(numbers));
        stay_ = moved ? 0 : stay_ + 1;
        health_.longest_stay = std::max(health_.longest_stay, stay_);
        ++health_.mutations;
    }

    [[nodiscard]] const WeightedPath& current() const { return current_; }
    [[nodiscard]] std::uint32_t steps() const { return step_; }
    /// Counts of this chain alone; summaries over chains are left at zero.
    [[nodiscard]] const ChainHealth& health() const { return health_; }
    /// Weights of all candidates of large steps, independent draws whose mean is P_c.
    [[nodiscard]] const WeightMoments& large_step_weights() const { return large_weights_; }

 private:
    /// Numbers of a step's decisions; those of its directions follow.
    enum Decision : std::uint32_t { kind, choice, acceptance_number, gap, count, split };
    static_assert(split < step_decisions);

    struct Directions {
        Random numbers;
        [[nodiscard]] float at(std::uint32_t d) const { return numbers.at(step_decisions + d); }
    };

    bool large_move(const Random& numbers) {
        for (std::uint32_t j = 0; j < options_.tries; ++j) {
            generator_.generate(sample_.propose_large(large_step(chain_, step_, j)),
                                candidates_[j]);
            weights_[j] = candidates_[j].weight;
        }
        for (const double w : weights_) large_weights_.add(w);
        const MultipleTry t =
            multiple_try(current_.weight, weights_, static_cast<double>(numbers.at(choice)),
                         static_cast<double>(numbers.at(acceptance_number)));
        if (!t.accepted) return false;
        std::swap(current_, candidates_[t.chosen]);
        sample_.accept_large(large_step(chain_, step_, t.chosen));
        return true;
    }

    bool small_move(const Random& numbers) {
        WeightedPath& y = candidates_[0];
        generator_.generate(sample_.propose_small(step_), y);
        if (!accepts(numbers, acceptance(current_.weight, y.weight))) return false;
        std::swap(current_, y);
        sample_.accept_small(step_);
        return true;
    }

    bool bidirectional_move(const Random& numbers) {
        WeightedPath& y = candidates_[0];
        const std::uint32_t k = current_.path.edges();
        const PathGap out = gaps_.sample_gap(k, static_cast<double>(numbers.at(gap)));
        const std::uint32_t n = gaps_.sample_count(k, out, static_cast<double>(numbers.at(count)));
        const std::uint32_t fewest = GapChoices::min_from_eye(out);
        const auto options = static_cast<float>(n - fewest + 1);
        const auto from_eye = fewest + static_cast<std::uint32_t>(numbers.at(split) * options);
        Directions u{numbers};
        if (!refill(generator_.world(), u, current_.path, out, n, from_eye, y.path)) return false;
        y.path.spread = spread_at(u);
        weigh(generator_.world(), y, [&](const PathMeasure& m) {
            return mixture_density(m, y.path.edges(), generator_.techniques());
        });
        if (!(y.weight > 0.0) || !accepts(numbers, bidirectional_acceptance(y, out, n)))
            return false;
        std::swap(current_, y);
        return true;
    }

    [[nodiscard]] double bidirectional_acceptance(const WeightedPath& y, PathGap out,
                                                  std::uint32_t n) const {
        const PathGap back{out.left, out.left + n + 1};
        const auto way = [&](const WeightedPath& from, PathGap hole, const WeightedPath& to,
                             std::uint32_t added) {
            const std::uint32_t k = from.path.edges();
            return Rules::choice(gaps_, k, hole, added) *
                   Rules::refill(to.measure, to.path.edges(), hole.left, added);
        };
        const double there = way(current_, out, y, n);
        if (!(there > 0.0)) return 0.0;
        return acceptance(luminance(current_.measure.contribution), there,
                          luminance(y.measure.contribution),
                          way(y, back, current_, out.vertices()));
    }

    static bool accepts(const Random& numbers, double probability) {
        return Rules::accepts(static_cast<double>(numbers.at(acceptance_number)), probability);
    }

    const Generator& generator_;
    ChainOptions options_;
    GapChoices gaps_;
    std::uint64_t seed_;
    std::uint32_t chain_;
    PrimarySample sample_;
    WeightedPath current_;
    std::vector<WeightedPath> candidates_;
    std::vector<double> weights_;
    WeightMoments large_weights_;
    ChainHealth health_;
    std::uint32_t step_ = 0;
    std::uint64_t stay_ = 0;
};

}  // namespace mir
