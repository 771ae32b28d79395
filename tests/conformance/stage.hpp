// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/data/image.hpp"
#include "mir/data/vpl_list.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/surface_table.hpp"
#include "mir/validation/detail/same_pixels.hpp"

#include <cstdint>

namespace mirtest {

/// The Cornell box with its blocks and walls made glossy.
inline mir::Scene glossy_box() {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    float roughness = 0.3f;
    for (mir::Material& m : scene.materials) {
        m.specular = 1.0f;
        m.roughness = roughness;
        roughness += 0.2f;
    }
    return scene;
}

/// Everything a scheduler needs, in a scene small enough for brute force: luxels that the box's
/// camera sees (those left and right of the box are empty) and VPLs spread over all surfaces. The
/// luxels depend on the extent alone, not on the tiles. `Engine` gives visibility and ray caster.
template <mir::Bsdf B, class Engine>
class Stage {
 public:
    using Params = typename B::Params;

    Stage(mir::Extent extent, mir::Extent tile, std::uint32_t vpls)
        : world_(glossy_box()), engine_(world_.geometry), gbuffer_(extent, tile) {
        mir::CameraRays rays;
        rays.camera = world_.scene.cameras.front();
        rays.grid.pixels = extent;
        mir::InlineExecutor executor;
        mir::fill_gbuffer<B>(gbuffer_, 0, rays, engine_.ray_caster(),
                             mir::SurfaceTable<B>(world_.scene), executor);
        mir::Random random = test_random(51);
        for (std::uint32_t j = 0; j < vpls; ++j) {
            const mir::SurfacePoint p = random_surface_point(world_.geometry, random);
            const mir::Vec3 n = p.geometric_normal;
            const mir::Vec3 at = mir::lift(p);
            vpls_.push_back({at, n, {random.next(), random.next(), 1.0f}}, {});
        }
    }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    ~Stage() = default;

    [[nodiscard]] const mir::BlockedGBuffer<Params>& gbuffer() const { return gbuffer_; }
    [[nodiscard]] mir::VplSpan<mir::Space::host> vpls() const { return vpls_.span(); }
    [[nodiscard]] auto visibility() const { return engine_.visibility(); }

 private:
    World world_;
    Engine engine_;
    mir::BlockedGBuffer<Params> gbuffer_;
    mir::VplList vpls_;
};

using mir::validation::detail::bits_of;
using mir::validation::detail::pixels_that_differ;

}  // namespace mirtest
