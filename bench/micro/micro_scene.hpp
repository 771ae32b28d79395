// SPDX-License-Identifier: MIT
#pragma once

#include "gpu_gathers.hpp"
#include "mir/micro/make_surfels.hpp"
#include "mir/micro/surfel_tree_build.hpp"
#include "support/bench_scene.hpp"

#include <vector>

namespace mirbench {

/// Some `count` discs of a scene: the largest ones that are as many (up to four times as many).
std::vector<mir::Surfel> surfels_of(const BenchScene& scene, double count);

/// Their hierarchy.
mir::SurfelTree tree_of(const BenchScene& scene, double count,
                        const mir::SurfelTreeOptions& options = {});

/// Exact rays from places that the camera sees, drawn at random, spread by the cosine.
std::vector<mir::SurfelRay> gather_rays(const BenchScene& scene, std::uint32_t count);

/// A picture of a scene made ready for gathers: what GatherInput views.
struct MicroScene {
    MicroScene(const BenchScene& from, mir::Extent image, double discs);

    [[nodiscard]] GatherInput input() const { return {luxels, tree, radiance, band}; }

    mir::SurfelTree tree;
    std::vector<mir::SurfelRadiance> radiance;  ///< direct light
    MicroLuxels luxels;
    mir::LuxelBand band;
};

/// From a cache that holds the last one asked for.
const MicroScene& micro_scene(const std::string& name, mir::Extent image, double discs);

}  // namespace mirbench
