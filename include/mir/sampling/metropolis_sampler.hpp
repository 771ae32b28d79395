// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/sampler.hpp"
#include "mir/core/limits.hpp"
#include "mir/metropolis/chain_ensemble.hpp"

namespace mir {

/// Intensity of a record before normalisation: the colour of R, at luminance 1.
struct UnitRadiance {
    /// R of a path that carries light, scaled to a luminance of 1.
    MIR_HD Rgb operator()(const WeightedPath& p) const {
        return with_unit_luminance(p.measure.leaving);
    }
};

/// Metropolis instant radiosity: VPLs where they matter to the camera. Once normalised, each brings
/// the same flux to the image. Model of Sampler, and of what the 2009 paper's algorithm 2 does.
/// Source: Segovia, Iehl, Peroche 2007; Pajot, Barthe, Paulin 2009, section 4. The scene data that
/// `world` refers to must outlive it; const use from any thread.
template <class World>
class MetropolisSampler {
 public:
    /// Records hold R; the image's response makes intensities of them.
    static constexpr Normalisation normalisation = Normalisation::image_response;

    /// @throws Error(invalid_argument) when options are out of range. Error(limit_exceeded) when
    /// more states are wanted than `limits` allows VPLs.
    MetropolisSampler(const World& world, const MetropolisOptions& options,
                      const Limits& limits = {})
        : options_(options),
          generator_(world,
                     TechniqueTable(options.min_edges(), options.max_edges(), options.techniques)),
          suffix_(world, generator_.techniques()) {
        options.check(limits);
    }

    /// Runs bootstrap and chains. No record comes out when no path carries light: a result of
    /// zero that health.luminance explains. Paths of the bootstrap come from `shared`, unless it is
    /// empty.
    template <Executor E>
    [[nodiscard]] VplRecords sample(E& executor, const SharedDraw& shared = {}) const {
        const ChainEnsemble<World, PathGenerator<World>> chains(generator_, suffix_, options_);
        return chains.run(UnitRadiance{}, executor, shared);
    }

 private:
    MetropolisOptions options_;
    PathGenerator<World> generator_;
    SuffixProposal<World> suffix_;
};

}  // namespace mir
