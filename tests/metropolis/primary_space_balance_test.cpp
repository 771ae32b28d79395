// SPDX-License-Identifier: MIT
// Detailed balance of steps in primary sample space, by exact enumeration of a toy that is cut into
// cells.
#include "metropolis/exact_rules.hpp"
#include "mir/metropolis/small_step.hpp"
#include "support/catch.hpp"

#include <algorithm>

using mirtest::balanced;
using mirtest::broken;
using mirtest::completed;
using mirtest::imbalance;
using mirtest::independent_tries;
using mirtest::loser_reuse;
using mirtest::no_transitions;
using mirtest::single_try;
using mirtest::stationary_error;
using mirtest::target;
using mirtest::TransitionMatrix;
using mirtest::Weights;

namespace {

/// Primary sample space in one dimension, cut into cells: the share of all numbers with which the
/// library's small step moves the middle of one cell into another.
TransitionMatrix small_steps(std::size_t cells) {
    const mir::SmallStep step(0.03f, 0.4f);
    constexpr int numbers = 4096;
    TransitionMatrix t = no_transitions(cells);
    for (std::size_t i = 0; i < cells; ++i)
        for (int k = 0; k < numbers; ++k) {
            const float middle = (static_cast<float>(i) + 0.5f) / static_cast<float>(cells);
            const float to = step.perturb(middle, static_cast<float>(k) / numbers);
            t[i][static_cast<std::size_t>(to * static_cast<float>(cells))] += 1.0 / numbers;
        }
    return t;
}

/// Contributions I(u) of the cells of a toy: a bright feature, dark gaps.
const Weights toy = {1, 1, 7, 4, 0, 0, 2, 1, 1, 0, 3, 1, 1, 1, 0, 2};

TransitionMatrix large_toy_steps(std::size_t tries) {
    const Weights uniform(toy.size(), 1.0 / static_cast<double>(toy.size()));
    return independent_tries(toy, uniform, tries, loser_reuse);
}

TransitionMatrix small_toy_steps() {
    return single_try(small_steps(toy.size()), [](std::size_t i, std::size_t j) {
        return toy[i] > 0.0 ? mir::acceptance(toy[i], toy[j]) : 0.0;
    });
}

}  // namespace

TEST_CASE("candidates that share random numbers are rejected") {
    // The second candidate is the neighbour of the first: each is uniform, the pair is not.
    const std::size_t n = toy.size();
    TransitionMatrix p = no_transitions(n);
    for (std::size_t x = 0; x < n; ++x)
        for (std::size_t first = 0; first < n && toy[x] > 0.0; ++first) {
            const std::size_t second = (first + 1) % n;
            const double sum = toy[first] + toy[second];
            for (int k = 0; k < static_cast<int>(sum); ++k) {
                const auto step = loser_reuse(toy[x], {toy[first], toy[second]}, (k + 0.5) / sum);
                p[x][step.chosen == 0 ? first : second] +=
                    step.acceptance / sum / static_cast<double>(n);
            }
        }
    CHECK(imbalance(toy, completed(p)) > broken);
}

TEST_CASE("large and small steps in primary sample space are in detailed balance") {
    const TransitionMatrix small = small_toy_steps();
    CHECK(imbalance(toy, small) < balanced);
    for (std::size_t tries : {1u, 2u, 3u}) {
        CAPTURE(tries);
        const TransitionMatrix large = large_toy_steps(tries);
        CHECK(imbalance(toy, large) < balanced);
        const auto half = [](std::size_t) { return 0.5; };
        CHECK(imbalance(toy, mirtest::mixture(large, small, half)) < balanced);
        CHECK(stationary_error(toy, mirtest::mixture(large, small, half)) < balanced);
    }
}

TEST_CASE("wrong steps in primary sample space are rejected") {
    SECTION("a share of large steps that depends on the state") {
        const auto share = [](std::size_t i) { return toy[i] > 2.0 ? 0.2 : 0.8; };
        CHECK(imbalance(toy, mirtest::mixture(large_toy_steps(2), small_toy_steps(), share)) >
              broken);
    }
    SECTION("a small step that moves one way") {
        TransitionMatrix upwards = small_steps(toy.size());
        for (std::size_t i = 0; i < toy.size(); ++i)
            for (std::size_t j = 0; j < toy.size(); ++j)
                upwards[i][j] *= (j + toy.size() - i) % toy.size() < toy.size() / 2 ? 2.0 : 0.0;
        CHECK(imbalance(toy, single_try(upwards, [](std::size_t i, std::size_t j) {
                            return toy[i] > 0.0 ? mir::acceptance(toy[i], toy[j]) : 0.0;
                        })) > broken);
    }
    SECTION("a small step that is clamped at the border") {
        TransitionMatrix clamped = no_transitions(4);
        for (std::size_t i = 0; i < 4; ++i) {
            clamped[i][std::min<std::size_t>(i + 2, 3)] += 0.5;
            clamped[i][i < 2 ? 0 : i - 2] += 0.5;
        }
        CHECK(imbalance(target, single_try(clamped, [](std::size_t i, std::size_t j) {
                            return mir::acceptance(target[i], target[j]);
                        })) > broken);
    }
    SECTION("every proposal with contribution accepted") {
        CHECK(imbalance(toy, single_try(small_steps(toy.size()), [](std::size_t i, std::size_t j) {
                            return toy[i] > 0.0 && toy[j] > 0.0 ? 1.0 : 0.0;
                        })) > broken);
    }
}
