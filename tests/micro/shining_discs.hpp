// SPDX-License-Identifier: MIT
#pragma once

#include "micro/surfel_worlds.hpp"
#include "mir/micro/surfel_radiance.hpp"

// Scenes whose discs shine by themselves, for tests of gatherers.

namespace mirtest {

/// The inside of a cube of edge 2 around the origin.
inline World shining_room() {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(mir::builtin::inside_out(
        mir::builtin::box("room", grey, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2})));
    return World(std::move(scene));
}

/// A square of edge 2 at height 1, its front downwards.
inline World shining_ceiling() {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(mir::builtin::quad("ceiling", grey, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}));
    return World(std::move(scene));
}

/// Fronts of all discs shine with radiance 1.
inline std::vector<mir::SurfelRadiance> shining(const mir::SurfelTree& tree) {
    mir::InlineExecutor executor;
    const auto light = [](const mir::SurfelFace&, std::uint64_t number) {
        return number % 2 == 0 ? mir::Rgb{1, 1, 1} : mir::Rgb{};
    };
    return mir::light_surfels(tree, light, 1e-4f, executor);
}

/// A white luxel, its position lifted already.
inline mir::SurfelFace luxel(mir::Vec3 position, mir::Vec3 normal = {0, 1, 0}) {
    return {{position, normal}, {normal, normal, {}, {{1, 1, 1}}}};
}

}  // namespace mirtest
