// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/random.hpp"
#include "mir/metropolis/small_step.hpp"

#include <cstdint>

namespace mir {

/// Independent draw of all coordinates at once: coordinate d is Random(seed, stream, index).at(d).
struct LargeStep {
    Stream stream = Stream::bootstrap;  ///< Stream::bootstrap for a chain's first state
    std::uint64_t index = 0;  ///< of the path in the bootstrap, or as large_step() packs it
};

/// Coordinates that a PrimarySample has.
inline constexpr std::uint32_t max_coordinates = 400;

/// Largest numbers that name a step of a chain; steps themselves use all 32 bits.
inline constexpr std::uint32_t max_chains = 1u << 22;
inline constexpr std::uint32_t max_tries = 255;  ///< of one step

/// The first numbers of a step are free for its decisions (kind, choice, acceptance). Number
/// `step_decisions + d` moves coordinate d.
inline constexpr std::uint32_t step_decisions = 8;

namespace detail {

// 2 unused bits, 22 of the chain, 8 of the part, 32 of the step.
MIR_HD inline std::uint64_t mutation_index(std::uint32_t chain, std::uint32_t step,
                                           std::uint32_t part) {
    expects_on_host(
        chain < max_chains,
        "there are more than 4194304 Markov chains (22 bits name a chain); ask for fewer");
    return (std::uint64_t{chain} << 40) | (std::uint64_t{part} << 32) | step;
}

}  // namespace detail

/// Numbers of step `step` of chain `chain`: its decisions and its small perturbations.
/// @throws Error(invalid_argument) unless chain < max_chains.
MIR_HD inline Random step_numbers(std::uint64_t seed, std::uint32_t chain, std::uint32_t step) {
    return {seed, Stream::mutation, detail::mutation_index(chain, step, 0)};
}

/// Large step that chain `chain` proposes at `step` as its try `attempt`. One try is number 0.
/// @throws Error(invalid_argument) unless chain < max_chains and attempt < max_tries.
MIR_HD inline LargeStep large_step(std::uint32_t chain, std::uint32_t step,
                                   std::uint32_t attempt = 0) {
    expects_on_host(attempt < max_tries,
                    "a step has more than 255 tries (8 bits name a try); ask for fewer");
    return {Stream::mutation, detail::mutation_index(chain, step, attempt + 1)};
}

/// State of a Markov chain in primary sample space, a point of [0, 1)^400. Coordinates are computed
/// when they are asked for. It is a pure function of seed, chain, the large step it descends from
/// and the small steps accepted since, so equal on any machine; what is cached never shows.
/// Proposals are views that write nothing: rejecting one costs nothing.
///
/// A value of 5.3 kB without memory elsewhere. Copies are independent. Not to be used by two
/// threads at once.
/// Source: Kelemen et al. 2002; the lazy evaluation is theirs, history instead of roll-back is not.
class PrimarySample {
 public:
    /// Proposal of moving every coordinate a little. Reads the state it was made from, and is
    /// invalid once that accepts a step.
    class SmallProposal {
     public:
        /// Of small step `step` from `current`, which must outlive it.
        MIR_HD SmallProposal(PrimarySample& current, std::uint32_t step)
            : current_(&current), step_(step) {}
        /// Coordinate `dimension`, in [0, 1).
        [[nodiscard]] MIR_HD float at(std::uint32_t dimension) const {
            return current_->moved(current_->at(dimension), step_, dimension);
        }

     private:
        PrimarySample* current_;
        std::uint32_t step_;
    };

    /// Of no chain; start() makes one of it.
    PrimarySample() = default;

    /// State that `base` drew, in chain `chain`, whose small steps follow `kernel`.
    /// @throws Error(invalid_argument) unless chain < max_chains.
    MIR_HD PrimarySample(std::uint64_t seed, std::uint32_t chain, LargeStep base,
                         const SmallStep& kernel = {}) {
        start(seed, chain, base, kernel);
    }

    /// Becomes that state, whatever it was. In place, for kernels that have no room for two.
    /// @throws Error(invalid_argument) unless chain < max_chains.
    MIR_HD void start(std::uint64_t seed, std::uint32_t chain, LargeStep base,
                      const SmallStep& kernel = {}) {
        expects_on_host(
            chain < max_chains,
            "there are more than 4194304 Markov chains (22 bits name a chain); ask for fewer");
        seed_ = seed;
        chain_ = chain;
        kernel_ = kernel;
        accept_large(base);
    }

    /// Coordinate `dimension` < max_coordinates of the state, in [0, 1). Not const because it fills
    /// the cache.
    [[nodiscard]] MIR_HD float at(std::uint32_t dimension) {
        touch(dimension);
        Coordinate& c = coordinates_[dimension];
        for (; c.steps < steps_; ++c.steps) c.value = moved(c.value, accepted_[c.steps], dimension);
        return c.value;
    }

    /// What the state becomes should the small step `step` be accepted.
    [[nodiscard]] MIR_HD SmallProposal propose_small(std::uint32_t step) { return {*this, step}; }

    /// What the state becomes should `large` be accepted: its at(d) is coordinate d.
    [[nodiscard]] MIR_HD Random propose_large(LargeStep large) const {
        return {seed_, large.stream, large.index};
    }

    /// Moves to propose_small(step).
    /// @throws Error(invalid_argument) unless steps are accepted in increasing order.
    MIR_HD void accept_small(std::uint32_t step) {
        expects_on_host(!moved_yet_ || last_ < step,
                        "a Markov chain accepts its small steps out of order (each step number "
                        "names its random numbers, once); number the steps of a chain upwards");
        if (steps_ == max_steps) forget_steps();
        accepted_[steps_++] = last_ = step;
        moved_yet_ = true;
    }

    /// Moves to propose_large(large).
    MIR_HD void accept_large(LargeStep large) {
        base_ = large;
        steps_ = touched_ = 0;
        moved_yet_ = false;
    }

 private:
    /// Small steps that are kept by number before all coordinates are moved by them. Between two
    /// accepted large steps there are rarely as many.
    static constexpr std::uint32_t max_steps = 512;

    struct Coordinate {
        float value = 0.0f;
        std::uint32_t steps = 0;  // how many of accepted_ the value has been moved by
    };

    [[nodiscard]] MIR_HD float moved(float value, std::uint32_t step,
                                     std::uint32_t dimension) const {
        return kernel_.perturb(value,
                               step_numbers(seed_, chain_, step).at(step_decisions + dimension));
    }

    MIR_HD void touch(std::uint32_t dimension) {
        const Random base = propose_large(base_);
        for (; touched_ <= dimension; ++touched_) coordinates_[touched_] = {base.at(touched_), 0};
    }

    MIR_HD void forget_steps() {
        for (std::uint32_t d = 0; d < max_coordinates; ++d) {
            static_cast<void>(at(d));
            coordinates_[d].steps = 0;
        }
        steps_ = 0;
    }

    std::uint64_t seed_ = 0;
    std::uint32_t chain_ = 0;
    SmallStep kernel_;
    LargeStep base_;
    std::uint32_t last_ = 0;     // small step accepted last
    bool moved_yet_ = false;     // whether a small step was accepted since base_
    std::uint32_t steps_ = 0;    // in accepted_
    std::uint32_t touched_ = 0;  // in coordinates_
    std::uint32_t accepted_[max_steps] = {};
    Coordinate coordinates_[max_coordinates];
};

}  // namespace mir
