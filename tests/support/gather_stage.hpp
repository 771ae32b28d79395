// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/micro/surfel_albedo.hpp"
#include "mir/micro/surfel_direct_light.hpp"
#include "mir/micro/surfel_tree_build.hpp"
#include "mir/resident/backend_gather.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"

#include <bit>
#include <type_traits>

namespace mirtest {

/// Luxels of the Cornell box in ragged tiles, and its discs with their direct light. Its walls are
/// glossy where the BSDF can be.
template <mir::Bsdf B>
struct GatherStage {
    using Luxels = mir::BlockedGBuffer<typename B::Params>;

    mir::Scene scene = [] {
        mir::Scene box = mir::builtin::cornell_box(mir::builtin::Lamp::down);
        if (std::is_same_v<B, mir::CookTorrance>)
            for (mir::Material& m : box.materials) m.specular = 1.0f, m.roughness = 0.4f;
        return box;
    }();
    mir::WorldGeometry geometry{scene};
    mir::KdTreeScene engine{geometry};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<B> surfaces{scene};
    mir::InlineExecutor executor;
    mir::LuxelBand band{0, {{45, 37}}, 5};
    mir::SurfelTree tree{make_surfels(geometry, {1e-3f}, {}, executor),
                         mir::SurfelAlbedo<B>(surfaces, geometry),
                         {},
                         executor};
    std::vector<mir::SurfelRadiance> radiance =
        light_surfels(mir::SurfelPatches(tree), direct_light(), geometry.ray_offset(), executor);
    Luxels luxels{band.grid.luxels(), {32, 16}};

    [[nodiscard]] auto direct_light() const {
        return mir::SurfelDirectLight<B, decltype(engine.ray_caster()),
                                      decltype(engine.visibility())>(
            {geometry, lights, surfaces, engine.ray_caster(), engine.visibility()}, 4, 1);
    }

    GatherStage() {
        const mir::CameraRays rays{scene.cameras.front(), band.grid, 0};
        fill_gbuffer<B>(luxels, 0, rays, engine.ray_caster(), surfaces, executor);
    }
};

/// Luxels at which two pictures differ in a bit.
inline std::size_t different_luxels(const mir::Image<mir::Rgb>& a, const mir::Image<mir::Rgb>& b) {
    using Words = std::array<std::uint32_t, 3>;
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        different +=
            std::bit_cast<Words>(a.pixels()[i]) == std::bit_cast<Words>(b.pixels()[i]) ? 0 : 1;
    return different;
}

}  // namespace mirtest
