// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/primary_sample.hpp"

#include <cstddef>
#include <vector>

namespace mirtest {

/// Ways to get lazy coordinates wrong.
enum class Fault {
    none,
    stale_coordinate,    ///< a coordinate that was left alone for two accepted steps misses them
    no_roll_back,        ///< a proposal writes the state, and rejection does not restore it
    large_step_forgets,  ///< an accepted large step leaves coordinates of the old state behind
    late_is_fresh,       ///< a coordinate touched late misses the steps accepted before
    one_way              ///< small steps only go upwards
};

/// PrimarySample with a fault; its equal with Fault::none.
template <Fault fault>
class FaultySample {
    struct Coordinate {
        float value = 0.0f;
        std::size_t steps = 0;
    };

 public:
    FaultySample(std::uint64_t seed, std::uint32_t chain, mir::LargeStep base,
                 const mir::SmallStep& kernel = {})
        : seed_(seed), chain_(chain), kernel_(kernel), base_(base) {}

    float at(std::uint32_t d) {
        const mir::Random numbers = propose_large(base_);
        while (cache_.size() <= d) {
            const auto next = static_cast<std::uint32_t>(cache_.size());
            cache_.push_back({numbers.at(next), fault == Fault::late_is_fresh ? steps_.size() : 0});
        }
        Coordinate& c = cache_[d];
        if (fault == Fault::stale_coordinate && c.steps + 1 < steps_.size())
            c.steps = steps_.size();
        for (; c.steps < steps_.size(); ++c.steps) c.value = moved(c.value, steps_[c.steps], d);
        return c.value;
    }

    struct Proposal {
        FaultySample* state;
        std::uint32_t step;
        float at(std::uint32_t d) const {
            const float value = state->moved(state->at(d), step, d);
            if (fault == Fault::no_roll_back) state->cache_[d].value = value;
            return value;
        }
    };
    Proposal propose_small(std::uint32_t step) { return {this, step}; }
    mir::Random propose_large(mir::LargeStep large) const {
        return {seed_, large.stream, large.index};
    }

    void accept_small(std::uint32_t step) {
        if (fault == Fault::no_roll_back) return;  // written already
        steps_.push_back(step);
    }
    void accept_large(mir::LargeStep large) {
        base_ = large;
        steps_.clear();
        if (fault != Fault::large_step_forgets) cache_.clear();
        for (Coordinate& c : cache_) c.steps = 0;
    }

 private:
    float moved(float value, std::uint32_t step, std::uint32_t d) const {
        const float number = mir::step_numbers(seed_, chain_, step).at(mir::step_decisions + d);
        return kernel_.perturb(value, fault == Fault::one_way ? 0.5f * number : number);
    }

    std::uint64_t seed_;
    std::uint32_t chain_;
    mir::SmallStep kernel_;
    mir::LargeStep base_;
    std::vector<std::uint32_t> steps_;
    std::vector<Coordinate> cache_;
};

}  // namespace mirtest
