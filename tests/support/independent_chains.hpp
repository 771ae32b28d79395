// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/bootstrap.hpp"
#include "mir/metropolis/chain.hpp"
#include "mir/metropolis/systematic_resampling.hpp"
#include "support/statistics.hpp"

#include <memory>

namespace mirtest {

/// Where P_c comes from when a chain is judged.
enum class Scale {
    same_set,    ///< the bootstrap that the chain starts from: E[P_c h(X_i)] = int h Y(F) always
    another_set  ///< an independent one: a chain too short then remembers its start
};

/// Runs `count` chains, each from a bootstrap of its own of `paths` paths, for `steps` steps and
/// calls f(P_c, last state). f(0, nothing) when no path of a bootstrap carries light.
template <class Rules = mir::ChainRules, class World, class F>
void each_chain(const mir::PathGenerator<World>& generator, const mir::ChainOptions& options,
                std::uint32_t count, std::uint64_t paths, std::uint32_t steps, Scale scale,
                std::uint64_t first_seed, const F& f) {
    mir::InlineExecutor executor;
    const mir::BootstrapOptions fixed{1.0, paths, paths};
    const auto memory = std::make_unique<mir::ChainState>();
    for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
        const auto b = mir::bootstrap(generator, fixed, seed, executor);
        double p_c = b.luminance.mean;
        if (scale == Scale::another_set)
            p_c = mir::bootstrap(generator, fixed, ~seed, executor).luminance.mean;
        if (b.luminance.contributing == 0) {
            f(p_c, nullptr);
            continue;
        }
        const mir::Random choice(seed, mir::Stream::seeding, 0);
        const double turn = mir::fine_uniform(choice.at(0), choice.at(1));
        const std::uint32_t start = mir::systematic_resampling(b.weights, 1, turn).front();
        mir::PathChain<World, Rules> chain(generator, options, seed, 0,
                                           {mir::Stream::bootstrap, std::uint64_t{start}}, *memory);
        for (std::uint32_t i = 0; i < steps; ++i) chain.step();
        f(p_c, &chain.current());
    }
}

}  // namespace mirtest
