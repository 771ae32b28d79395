// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cpu/embree_scene.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/scene/light_table.hpp"

#include <cstdint>
#include <utility>

namespace mirbench {

/// A scene ready to be lit, and what its camera sees of it. One thread; not to be moved.
template <mir::Bsdf B>
struct StudyScene {
    /// Looks at `of` with the same random numbers each time.
    StudyScene(mir::Scene of, mir::Extent pixels, std::uint32_t luxels_per_pixel)
        : scene(std::move(of)), grid(mir::luxel_grid(pixels, luxels_per_pixel, {})) {
        mir::fill_gbuffer<B>(gbuffer, 0, rays, engine.ray_caster(), surfaces, executor);
    }

    mir::InlineExecutor executor;                          ///< of the study
    mir::Scene scene;                                      ///< as it was given
    mir::WorldGeometry geometry{scene};                    ///< of the scene
    mir::cpu::EmbreeScene engine{geometry};                ///< traces rays
    mir::LightTable lights{scene, geometry};               ///< of the scene
    mir::SurfaceTable<B> surfaces{scene};                  ///< of the scene
    mir::LuxelGrid grid;                                   ///< of the picture
    mir::CameraRays rays{scene.cameras.front(), grid, 7};  ///< to luxels
    mir::BlockedGBuffer<typename B::Params> gbuffer{grid.luxels(), {256, 256}};  ///< the luxels
};

}  // namespace mirbench
