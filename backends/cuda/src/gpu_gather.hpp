// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/backend.hpp"
#include "mir/resident/backend_gather.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"

#include <functional>
#include <memory>

namespace mir::cuda {

/// Called after every portion of so many luxels; may throw.
using GatherProgress = std::function<void(std::uint64_t)>;

/// gather_light() on a GPU (gpu_gather.cu). The tree that was asked for first stays there: one
/// gatherer for each tree. One thread at a time.
template <Bsdf F>
class GpuGather {
 public:
    using Luxels = BlockedGBuffer<typename F::Params>;

    /// `backend` must outlive it.
    explicit GpuGather(const Backend& backend) : backend_(backend) {}

    /// `options` are GatherOptions or BufferGatherOptions; done(n) as of BackendGather.
    /// @throws Error(out_of_memory), Error(device), and what done() throws
    template <class Options>
    [[nodiscard]] Image<Rgb> operator()(const Luxels& luxels, const SurfelTree& tree,
                                        std::span<const SurfelRadiance> radiance,
                                        const Options& options, const LuxelBand& band,
                                        const GatherProgress& done) const;

 private:
    const Backend& backend_;
    mutable std::unique_ptr<BackendGather<Backend, F>> there_;
};

}  // namespace mir::cuda
