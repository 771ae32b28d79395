// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/micro/gather_options.hpp"
#include "mir/micro/surfel_radiance.hpp"
#include "mir/micro/surfel_tree.hpp"
#include "runtime/compiled_bsdfs.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <variant>

namespace mir {

/// By rays or by micro-buffers.
using DiscGatherOptions = std::variant<GatherOptions, BufferGatherOptions>;

/// A machine that luxels gather light on, from discs. For one tree at a time; one thread at a time.
class DiscGather {
 public:
    /// Called after every portion of so many luxels; may throw.
    using Done = std::function<void(std::uint64_t)>;

    DiscGather() = default;
    DiscGather(const DiscGather&) = delete;
    DiscGather& operator=(const DiscGather&) = delete;
    virtual ~DiscGather() = default;

    /// gather_light() there, W m^-2 sr^-1.
    [[nodiscard]] virtual Image<Rgb> gather(const AnyLuxels& luxels, const SurfelTree& tree,
                                            std::span<const SurfelRadiance> radiance,
                                            const DiscGatherOptions& options, const LuxelBand& band,
                                            const Done& done) = 0;
};

}  // namespace mir
