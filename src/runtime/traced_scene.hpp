// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/visibility_matrix.hpp"
#include "mir/runtime/any_engine.hpp"
#include "mir/runtime/any_executor.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "runtime/compiled_bsdfs.hpp"

#include <memory>
#include <utility>

namespace mir {

/// A scene that the host traces rays through, by any engine. Owns the engine.
class TracedScene {
 public:
    /// `engine` offers ray_caster() and visibility(). It must not be null; what it was made from
    /// must outlive this.
    template <class Engine>
    explicit TracedScene(std::unique_ptr<const Engine> engine)
        : rays_(*engine), engine_(std::move(engine)) {}

    /// For single rays and packets.
    [[nodiscard]] const AnyEngine& rays() const { return rays_; }

    /// fill_visibility() by blocks where the engine answers them, by packets elsewhere.
    void fill_visibility(VisibilityMatrix& matrix, const AnyLuxels& luxels,
                         VplSpan<Space::host> vpls, AnyExecutor& executor) const;
    /// The same of reconstruct(), the geometry term bounded by `bound`, m^-2.
    [[nodiscard]] Image<Rgb> reconstruct(const sched::CpuBlocks<AnyExecutor>& scheduler,
                                         const AnyLuxels& luxels, VplSpan<Space::host> vpls,
                                         float bound) const;
    /// What the bound removes, always by packets: few VPLs reach a block with it.
    [[nodiscard]] Image<Rgb> removed(const sched::CpuBlocks<AnyExecutor>& scheduler,
                                     const AnyLuxels& luxels, VplSpan<Space::host> vpls,
                                     float bound) const;

 private:
    AnyEngine rays_;
    std::shared_ptr<const void> engine_;
};

}  // namespace mir
