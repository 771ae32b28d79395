// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/data/vpl_record.hpp"
#include "mir/runtime/any_engine.hpp"
#include "mir/runtime/any_executor.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/scene/scene.hpp"
#include "mir/scene/world_geometry.hpp"

#include <memory>

namespace mir {

/// A picture on the processor that lacks only its VPLs. For samplers of your own, which trace
/// through its members. Of mir::runtime. One thread at a time.
class VplFrame {
 public:
    /// Checks settings and scene, builds what rays go through and chooses the bound. The scene must
    /// outlive it; `monitor` may be null, else it must too. Settings of backend and
    /// integrator mean nothing, those of samplers only to place_vpls().
    /// @throws Error as Renderer::render(); Error(unsupported) for a scheduler that the processor
    ///         has not.
    VplFrame(const Scene& scene, const RenderSettings& settings, Monitor* monitor = nullptr);
    VplFrame(const VplFrame&) = delete;
    VplFrame& operator=(const VplFrame&) = delete;
    ~VplFrame();

    /// The triangles, in world space, of the scene near its origin (Scene::origin).
    [[nodiscard]] const WorldGeometry& geometry() const;
    /// The lights of that scene.
    [[nodiscard]] const LightTable& lights() const;
    /// Closest hits; valid as long as this.
    [[nodiscard]] AnyRayCaster ray_caster() const;
    /// Whether points see each other; valid as long as this.
    [[nodiscard]] AnyVisibility visibility() const;
    /// Largest geometry term of a VPL, m^-2, for samplers that look at the image.
    [[nodiscard]] float bound() const;
    /// The threads of the settings, stopped by the monitor.
    [[nodiscard]] AnyExecutor& executor();
    /// The VPLs of the sampler that the settings name, with the intensities that they have in a
    /// picture. To be called once, and not before render_vpls().
    /// @throws Error as Renderer::render().
    [[nodiscard]] VplList place_vpls();

 private:
    struct Parts;

    friend RenderResult render_vpls(VplFrame& frame, const SampledVpls& sampled);

    std::unique_ptr<Parts> parts_;
};

/// Renders by VPLs that you sampled, as mir::render() does by its own. To be called once.
/// @throws Error as Renderer::render().
[[nodiscard]] RenderResult render_vpls(VplFrame& frame, const SampledVpls& sampled);

}  // namespace mir
