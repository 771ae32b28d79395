// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cpu/any_scheduler.hpp"
#include "mir/cpu/tbb_executor.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/fill_visibility.hpp"
#include "mir/reconstruct.hpp"
#include "mir/runtime/any_engine.hpp"
#include "mir/runtime/cancellable_executor.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"

namespace mir::cpu {

/// The loops of a render.
using HostLoops = CancellableExecutor<TbbExecutor>;

/// An engine of which a render knows no more than virtual calls: for single rays (AnyEngine), and
/// for the loops with its traversal inside (LoopEngine), one call for all luxels and VPLs.
class HostEngine {
 public:
    template <class TracedScene>
    explicit HostEngine(const TracedScene& scene) : any_(scene) {}
    HostEngine(const HostEngine&) = delete;
    HostEngine& operator=(const HostEngine&) = delete;
    virtual ~HostEngine() = default;

    [[nodiscard]] const AnyEngine& any() const { return any_; }
    [[nodiscard]] AnyRayCaster ray_caster() const { return any_.ray_caster(); }
    [[nodiscard]] AnyVisibility visibility() const { return any_.visibility(); }

    using Matrix = VisibilityMatrix;
    using Order = AnyScheduler<HostLoops>;
    using Vpls = VplSpan<Space::host>;
    template <Bsdf B>
    using Luxels = BlockedGBuffer<typename B::Params>;

    virtual void fill_visibility(Matrix&, const Luxels<Lambert>&, Vpls, HostLoops&) const = 0;
    virtual void fill_visibility(Matrix&, const Luxels<CookTorrance>&, Vpls, HostLoops&) const = 0;
    [[nodiscard]] virtual Image<Rgb> reconstruct(const Order&, const Luxels<Lambert>&, Vpls,
                                                 const VplShading<Lambert>&) const = 0;
    [[nodiscard]] virtual Image<Rgb> reconstruct(const Order&, const Luxels<Lambert>&, Vpls,
                                                 const RemovedByBound<Lambert>&) const = 0;
    [[nodiscard]] virtual Image<Rgb> reconstruct(const Order&, const Luxels<CookTorrance>&, Vpls,
                                                 const VplShading<CookTorrance>&) const = 0;
    [[nodiscard]] virtual Image<Rgb> reconstruct(const Order&, const Luxels<CookTorrance>&, Vpls,
                                                 const RemovedByBound<CookTorrance>&) const = 0;

 private:
    AnyEngine any_;
};

/// A HostEngine over a scene to trace through, which must outlive it. In a file of its own for each
/// kind of scene, because its loops take the compiler long.
template <class TracedScene>
class HostEngineOf final : public HostEngine {
 public:
    explicit HostEngineOf(const TracedScene& scene) : HostEngine(scene), scene_(scene) {}

    void fill_visibility(Matrix& m, const Luxels<Lambert>& l, Vpls v, HostLoops& e) const override {
        mir::fill_visibility(m, l, v, scene_.visibility(), e);
    }
    void fill_visibility(Matrix& m, const Luxels<CookTorrance>& l, Vpls v,
                         HostLoops& e) const override {
        mir::fill_visibility(m, l, v, scene_.visibility(), e);
    }
    [[nodiscard]] Image<Rgb> reconstruct(const Order& o, const Luxels<Lambert>& l, Vpls v,
                                         const VplShading<Lambert>& shading) const override {
        return mir::reconstruct(o, l, v, scene_.visibility(), shading);
    }
    [[nodiscard]] Image<Rgb> reconstruct(const Order& o, const Luxels<Lambert>& l, Vpls v,
                                         const RemovedByBound<Lambert>& shading) const override {
        return mir::reconstruct(o, l, v, scene_.visibility(), shading);
    }
    [[nodiscard]] Image<Rgb> reconstruct(const Order& o, const Luxels<CookTorrance>& l, Vpls v,
                                         const VplShading<CookTorrance>& shading) const override {
        return mir::reconstruct(o, l, v, scene_.visibility(), shading);
    }
    [[nodiscard]] Image<Rgb> reconstruct(
        const Order& o, const Luxels<CookTorrance>& l, Vpls v,
        const RemovedByBound<CookTorrance>& shading) const override {
        return mir::reconstruct(o, l, v, scene_.visibility(), shading);
    }

 private:
    const TracedScene& scene_;
};

}  // namespace mir::cpu
