// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/visibility_matrix.hpp"
#include "mir/fill_visibility.hpp"
#include "mir/reconstruct.hpp"
#include "mir/runtime/any_engine.hpp"
#include "mir/runtime/any_executor.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "runtime/compiled_bsdfs.hpp"
#include "runtime/vpl_kernel.hpp"

#include <memory>
#include <utility>

namespace mir {

/// A scene that the host traces rays through. Single ones by virtual calls, those of many luxels
/// and VPLs by loops that have the traversal inside, one virtual call for all of them.
class TracedScene {
 public:
    TracedScene(const TracedScene&) = delete;
    TracedScene& operator=(const TracedScene&) = delete;
    virtual ~TracedScene() = default;

    /// For single rays.
    [[nodiscard]] const AnyEngine& rays() const { return rays_; }

    /// fill_visibility() with the scene's own visibility.
    virtual void fill_visibility(VisibilityMatrix& matrix, const AnyLuxels& luxels,
                                 VplSpan<Space::host> vpls, AnyExecutor& executor) const = 0;
    /// The same of reconstruct(), for points and for what was removed of them.
    [[nodiscard]] virtual Image<Rgb> reconstruct(const sched::CpuBlocks<AnyExecutor>& scheduler,
                                                 const AnyLuxels& luxels, VplSpan<Space::host> vpls,
                                                 VplKernel kernel) const = 0;

 protected:
    /// `engine` offers ray_caster() and visibility(); what these read must outlive this.
    template <class Engine>
    explicit TracedScene(const Engine& engine) : rays_(engine) {}

 private:
    AnyEngine rays_;
};

/// A TracedScene over an engine, which offers ray_caster() and visibility(). In a file of its own
/// for each engine, because its loops take the compiler long.
template <class Engine>
class TracedSceneOf final : public TracedScene {
 public:
    /// `engine` must not be null; what it was made from must outlive this.
    explicit TracedSceneOf(std::unique_ptr<const Engine> engine)
        : TracedScene(*engine), engine_(std::move(engine)) {}

    void fill_visibility(VisibilityMatrix& matrix, const AnyLuxels& luxels,
                         VplSpan<Space::host> vpls, AnyExecutor& executor) const override {
        std::visit(
            [&](const auto& of) {
                mir::fill_visibility(matrix, of.gbuffer, vpls, engine_->visibility(), executor);
            },
            luxels);
    }

    [[nodiscard]] Image<Rgb> reconstruct(const sched::CpuBlocks<AnyExecutor>& scheduler,
                                         const AnyLuxels& luxels, VplSpan<Space::host> vpls,
                                         VplKernel kernel) const override {
        return std::visit(
            [&]<Bsdf B>(const LuxelsOf<B>& of) {
                return with_shading<B>(kernel, [&](const auto& shading) {
                    return mir::reconstruct(scheduler, of.gbuffer, vpls, engine_->visibility(),
                                            shading);
                });
            },
            luxels);
    }

 private:
    std::unique_ptr<const Engine> engine_;
};

}  // namespace mir
