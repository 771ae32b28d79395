// SPDX-License-Identifier: MIT
#pragma once

#include "accel/build_worlds.hpp"
#include "mir/micro/surfel_tree_build.hpp"

// What tests of disc hierarchies share.

namespace mirtest {

inline std::vector<mir::Surfel> surfels_of(const World& world, float max_area,
                                           mir::DiscExtent extent = mir::DiscExtent::piece) {
    mir::InlineExecutor executor;
    return mir::make_surfels(world.geometry, {max_area, extent}, {}, executor);
}

/// The base colour of a disc's material. The world must outlive it.
inline auto base_color(const World& world) {
    return [&world](const mir::Surfel& s) { return world.scene.materials[s.material].base_color; };
}

inline mir::SurfelTree tree_of(const World& world, float max_area,
                               const mir::SurfelTreeOptions& options = {},
                               mir::DiscExtent extent = mir::DiscExtent::piece) {
    mir::InlineExecutor executor;
    return {surfels_of(world, max_area, extent), base_color(world), options, executor};
}

/// A sheet of 1 m x 1 m with a front of two quads, back to back a tenth of a millimetre apart: the
/// normals of any part with both sides cancel. Its sides are of different materials.
inline World thin_wall() {
    mir::Scene scene;
    const std::uint32_t red = scene.add(mir::lambertian("red", {0.9f, 0.1f, 0.1f}));
    const std::uint32_t blue = scene.add(mir::lambertian("blue", {0.1f, 0.2f, 0.8f}));
    scene.place(mir::builtin::quad("front", red, {0, 0, 5e-5f}, {1, 0, 0}, {0, 1, 0}));
    scene.place(mir::builtin::quad("back", blue, {0, 0, -5e-5f}, {0, 1, 0}, {1, 0, 0}));
    return World(std::move(scene));
}

}  // namespace mirtest
