// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/sampler.hpp"
#include "mir/core/limits.hpp"
#include "mir/metropolis/chain_ensemble.hpp"
#include "mir/sampling/target_floor.hpp"

#include <utility>

namespace mir {

/// Metropolis instant radiosity whose chains run over light paths alone. A path is z = (x2, ...,
/// x_k), and its target P~ is the response of a probe of the image (VplGenerator). The target of
/// each state is known, so the records are final: J = (P~_c / n) R / P~, unbiased at every pixel
/// for any number of luxels. VPLs bring the same flux to the luxels of the probe, not exactly to
/// the image. Model of Sampler; docs/method.md, section 10. Scene data and probe must outlive it;
/// const use from any thread.
template <class World>
class ProposalSampler {
 public:
    static constexpr Normalisation normalisation = Normalisation::none;  ///< records are final

    using Generator = VplGenerator<World>;    ///< of light paths with their target
    using Probe = typename Generator::Probe;  ///< luxels whose response is the target

    /// Paths are always built from both ends. health.luminance of the result is that of P~.
    /// @throws Error(invalid_argument) when options are out of range or ask for Veach's mutations,
    ///         which need a camera; Error(limit_exceeded) when more states are wanted than `limits`
    ///         allows VPLs.
    ProposalSampler(World world, const Probe& probe, const MetropolisOptions& options,
                    TargetFloor floor = {}, const Limits& limits = {})
        : world_(std::move(world)), probe_(probe), options_(options), floor_(floor) {
        options.check(limits);
        floor.validate();
        expects(options.chain.mutation == Mutation::primary,
                "chains over light paths without a camera have no bidirectional mutations; use "
                "primary ones");
        static_cast<void>(table());
    }

    /// Runs pilot, bootstrap and chains. No record comes out when no path carries light: a result
    /// of zero that health.luminance explains.
    template <Executor E>
    [[nodiscard]] VplRecords sample(E& executor) const {
        const auto generator =
            generator_with_floor<Generator>(world_, probe_, options_.min_edges(),
                                            options_.max_edges(), floor_, options_.seed, executor);
        const SuffixProposal<World> suffix(world_, generator.techniques(), generator.floor());
        const ChainEnsemble<World, Generator> chains(generator, suffix, options_);
        VplRecords out = chains.run(
            [&](const WeightedPath& p) {
                return narrowed(p.measure.leaving * (1.0 / generator.target(p.measure)));
            },
            executor);
        for (VplRecord& r : out.records)
            r.vpl.intensity = r.vpl.intensity * static_cast<float>(out.path_luminance / out.states *
                                                                   static_cast<double>(r.weight));
        out.non_lambertian_share = share_of_non_lambertian(out.records);
        return out;
    }

 private:
    [[nodiscard]] TechniqueTable table() const {
        return {options_.min_edges(), options_.max_edges(), PathTechniques::bidirectional};
    }

    World world_;
    const Probe& probe_;
    MetropolisOptions options_;
    TargetFloor floor_;
};

}  // namespace mir
