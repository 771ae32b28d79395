// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_options.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/sampling/visible_area.hpp"
#include "mir/scene/scene_hash.hpp"
#include "mir/shading/vpl_shading.hpp"

#include <string>

namespace mirbench {

/// Every suite shades with the full model, so that figures of Lambertian and glossy scenes compare.
using Bsdf = mir::CookTorrance;
using GBuffer = mir::BlockedGBuffer<Bsdf::Params>;

/// The paper's image: 1.92 million luxels (section 6).
inline constexpr mir::Extent paper_image{1600, 1200};

/// A scene made ready for reconstruction: geometry, ray engine, camera and VPLs. Made once per
/// process and name, see bench_scene().
struct BenchScene {
    explicit BenchScene(mir::Scene from);

    /// Luxels of an image as the camera sees it, in tiles of `tile`.
    [[nodiscard]] GBuffer gbuffer(mir::Extent image, mir::Extent tile) const;

    /// Exactly `count` VPLs (fewer only if the scene yields none), the same for every suite.
    [[nodiscard]] mir::VplList vpls(std::uint32_t count) const;

    /// Shading with the bound that `mir render` would choose.
    [[nodiscard]] mir::VplShading<Bsdf> shading(std::uint32_t vpls) const;

    mir::Scene scene;
    std::string hash;
    mir::WorldGeometry geometry;
    mir::cpu::EmbreeScene engine;
    mir::LightTable lights;
    mir::SurfaceTable<Bsdf> surfaces;
    double visible_area = 0.0;
};

/// `builtin:NAME` or a glTF file, from a cache that lives as long as the program.
const BenchScene& bench_scene(const std::string& name);

/// Scenes of a run: those named by the environment variable MIR_BENCH_SCENES (separated by commas),
/// else the built-in sphere.
std::vector<std::string> scenes_of_run();

/// How wide hierarchies of a run are built: as the library does it, but for splits named by the
/// environment variable MIR_BENCH_SPLITS.
mir::WideBvhOptions wide_options_of_run();

/// Number of luxel-VPL pairs that face each other, those that need a ray.
std::uint64_t count_facing(const GBuffer& gbuffer, const mir::VplList& vpls,
                           mir::TbbExecutor& executor);

}  // namespace mirbench
