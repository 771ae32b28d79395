// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/random.hpp"
#include "mir/metropolis/small_step.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mir {

/// Independent draw of all coordinates at once: coordinate d is Random(seed, stream, index).at(d).
struct LargeStep {
    Stream stream = Stream::bootstrap;
    std::uint64_t index = 0;
    friend constexpr bool operator==(const LargeStep&, const LargeStep&) = default;
};

/// Largest numbers that name a step of a chain; steps themselves use all 32 bits.
inline constexpr std::uint32_t max_chains = 1u << 16;
inline constexpr std::uint32_t max_tries = 255;

/// The first numbers of a step are free for its decisions (kind, choice, acceptance); number
/// `step_decisions + d` moves coordinate d.
inline constexpr std::uint32_t step_decisions = 8;

namespace detail {

// 8 unused bits, 16 of the chain, 8 of the part, 32 of the step.
inline std::uint64_t mutation_index(std::uint32_t chain, std::uint32_t step, std::uint32_t part) {
    expects(chain < max_chains,
            "there are more than 65536 Markov chains (16 bits name a chain); ask for fewer");
    return (std::uint64_t{chain} << 40) | (std::uint64_t{part} << 32) | step;
}

}  // namespace detail

/// Numbers of step `step` of chain `chain`: its decisions and its small perturbations.
/// @throws Error(invalid_argument) unless chain < max_chains.
inline Random step_numbers(std::uint64_t seed, std::uint32_t chain, std::uint32_t step) {
    return {seed, Stream::mutation, detail::mutation_index(chain, step, 0)};
}

/// Large step that chain `chain` proposes at `step` as its try `attempt`; one try is number 0.
/// @throws Error(invalid_argument) unless chain < max_chains and attempt < max_tries.
inline LargeStep large_step(std::uint32_t chain, std::uint32_t step, std::uint32_t attempt = 0) {
    expects(attempt < max_tries,
            "a step has more than 255 tries (8 bits name a try); ask for fewer");
    return {Stream::mutation, detail::mutation_index(chain, step, attempt + 1)};
}

/// State of a Markov chain in primary sample space: a point of [0, 1)^infinity whose coordinates
/// are computed when they are asked for. It is a pure function of seed, chain, the large step it
/// descends from and the small steps accepted since, so equal on any machine; what is cached never
/// shows. Proposals are views that write nothing: rejecting one costs nothing.
///
/// Asking for coordinate d reserves memory for all coordinates up to d; dimensions are meant to be
/// small. Copies are independent. Not to be used by two threads at once.
/// Source: Kelemen et al. 2002; the lazy evaluation is theirs, history instead of roll-back is not.
class PrimarySample {
 public:
    /// Proposal of moving every coordinate a little; reads the state it was made from, and is
    /// invalid once that accepts a step.
    class SmallProposal {
     public:
        SmallProposal(PrimarySample& current, std::uint32_t step)
            : current_(&current), step_(step) {}
        /// Coordinate `dimension`, in [0, 1).
        [[nodiscard]] float at(std::uint32_t dimension) const {
            return current_->moved(current_->at(dimension), step_, dimension);
        }

     private:
        PrimarySample* current_;
        std::uint32_t step_;
    };

    /// State that `base` drew, in chain `chain`, whose small steps follow `kernel`.
    /// @throws Error(invalid_argument) unless chain < max_chains.
    PrimarySample(std::uint64_t seed, std::uint32_t chain, LargeStep base,
                  const SmallStep& kernel = {})
        : seed_(seed), chain_(chain), kernel_(kernel), base_(base) {
        expects(chain < max_chains,
                "there are more than 65536 Markov chains (16 bits name a chain); ask for fewer");
    }

    /// Coordinate `dimension` of the state, in [0, 1). Not const because it fills the cache.
    [[nodiscard]] float at(std::uint32_t dimension) {
        touch(dimension);
        Coordinate& c = coordinates_[dimension];
        for (; c.steps < accepted_.size(); ++c.steps)
            c.value = moved(c.value, accepted_[c.steps], dimension);
        return c.value;
    }

    /// What the state becomes should the small step `step` be accepted.
    [[nodiscard]] SmallProposal propose_small(std::uint32_t step) { return {*this, step}; }

    /// What the state becomes should `large` be accepted: its at(d) is coordinate d.
    [[nodiscard]] Random propose_large(LargeStep large) const {
        return {seed_, large.stream, large.index};
    }

    /// Moves to propose_small(step).
    /// @throws Error(invalid_argument) unless steps are accepted in increasing order.
    void accept_small(std::uint32_t step) {
        expects(accepted_.empty() || accepted_.back() < step,
                "a Markov chain accepts its small steps out of order (each step number names its "
                "random numbers, once); number the steps of a chain upwards");
        accepted_.push_back(step);
    }

    /// Moves to propose_large(large).
    void accept_large(LargeStep large) {
        base_ = large;
        accepted_.clear();
        coordinates_.clear();
    }

    /// The large step the state descends from, and the small steps accepted since: with seed, chain
    /// and kernel they are the state.
    [[nodiscard]] LargeStep base() const { return base_; }
    [[nodiscard]] std::span<const std::uint32_t> accepted() const { return accepted_; }

 private:
    struct Coordinate {
        float value = 0.0f;
        std::uint32_t steps = 0;  // how many of accepted_ the value has been moved by
    };

    [[nodiscard]] float moved(float value, std::uint32_t step, std::uint32_t dimension) const {
        return kernel_.perturb(value,
                               step_numbers(seed_, chain_, step).at(step_decisions + dimension));
    }

    void touch(std::uint32_t dimension) {
        const Random base = propose_large(base_);
        for (auto d = static_cast<std::uint32_t>(coordinates_.size()); d <= dimension; ++d)
            coordinates_.push_back({base.at(d), 0});
    }

    std::uint64_t seed_;
    std::uint32_t chain_;
    SmallStep kernel_;
    LargeStep base_;
    std::vector<std::uint32_t> accepted_;
    std::vector<Coordinate> coordinates_;
};

}  // namespace mir
