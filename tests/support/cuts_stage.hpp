// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/cuts/deviation_cut.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/reconstruct_cuts.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/surface_table.hpp"
#include "mir/validation/worlds.hpp"
#include "support/backend_cuts.hpp"

#include <string_view>
#include <type_traits>
#include <vector>

namespace mirtest {

/// Luxels of a built-in scene and a tree of VPLs that are spread over its surfaces. What they shine
/// with differs by a factor of hundreds; surfaces are glossy where the BSDF can be.
template <mir::Bsdf B>
struct CutsStage {
    using Params = typename B::Params;
    using Luxels = mir::BlockedGBuffer<Params>;

    mir::Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::KdTreeScene engine{geometry};
    mir::InlineExecutor executor;
    mir::VplShading<B> shading;
    Luxels luxels;
    std::vector<mir::Vpl> vpls;
    mir::VplTree tree;

    CutsStage(std::string_view name, mir::Extent extent, mir::Extent tile, std::uint32_t count,
              float bound)
        : scene(made(name)),
          shading{bound},
          luxels(extent, tile),
          vpls(spread(count)),
          tree(mir::span_of(vpls), executor) {
        mir::CameraRays rays;
        rays.camera = scene.cameras.front();
        rays.grid.pixels = extent;
        fill_gbuffer<B>(luxels, 0, rays, engine.ray_caster(), mir::SurfaceTable<B>(scene),
                        executor);
    }

    /// reconstruct_cuts() on the host.
    [[nodiscard]] mir::Image<mir::Rgb> on_host(std::uint32_t picks, const mir::CutPlace& place,
                                               mir::Monitor* monitor = nullptr) {
        return reconstruct_cuts(luxels, tree, engine.visibility(), shading,
                                mir::DeviationCut{picks}, place, executor, monitor);
    }
    /// The same, for a backend.
    [[nodiscard]] CutsAsked<B> asked(std::uint32_t picks, const mir::CutPlace& place,
                                     mir::Monitor* monitor = nullptr) const {
        return {luxels, mir::span_of(vpls), shading, picks, place, monitor};
    }

 private:
    static mir::Scene made(std::string_view name) {
        mir::Scene scene = mir::builtin::make(name);
        if (std::is_same_v<B, mir::CookTorrance>)
            for (mir::Material& m : scene.materials) m.specular = 1.0f, m.roughness = 0.3f;
        return scene;
    }
    [[nodiscard]] std::vector<mir::Vpl> spread(std::uint32_t count) const {
        mir::Random random(7, mir::Stream::test, 3);
        std::vector<mir::Vpl> all;
        for (std::uint32_t j = 0; j < count; ++j) {
            const mir::SurfacePoint p = mir::validation::random_surface_point(geometry, random);
            const float x = random.next();
            all.push_back({mir::lift(p), p.geometric_normal, {x * x, 0.01f, random.next() * x}});
        }
        return all;
    }
};

}  // namespace mirtest
