// SPDX-License-Identifier: MIT
#pragma once

#include "mir/resident/backend_gather.hpp"
#include "runtime/disc_gather.hpp"

#include <memory>

namespace mir {

/// Light gathered on a backend, by luxels of one model. The tree that was asked for first stays
/// there: one for each tree.
template <Backend M, Bsdf B>
class BackendDiscGather final : public DiscGather {
 public:
    explicit BackendDiscGather(const M& machine) : machine_(machine) {}

    /// @throws Error(out_of_memory), Error(device), and what done() throws.
    [[nodiscard]] Image<Rgb> gather(const AnyLuxels& luxels, const SurfelTree& tree,
                                    std::span<const SurfelRadiance> radiance,
                                    const DiscGatherOptions& options, const LuxelBand& band,
                                    const Done& done) override;

 private:
    M machine_;
    std::unique_ptr<BackendGather<M, B>> there_;
};

}  // namespace mir
