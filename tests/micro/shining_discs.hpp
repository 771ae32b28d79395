// SPDX-License-Identifier: MIT
#pragma once

#include "micro/surfel_worlds.hpp"
#include "mir/micro/surfel_radiance.hpp"
#include "mir/shading/lambert.hpp"

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

/// The light under which a face sends out `radiance`; its albedo must not be black.
inline mir::Rgb light_for(const mir::SurfelFace& face, mir::Rgb radiance) {
    const mir::Rgb albedo = face.tree.albedo[face.node];
    return {radiance.r / albedo.r, radiance.g / albedo.g, radiance.b / albedo.b};
}

/// Fronts of all discs shine with radiance 1.
inline std::vector<mir::SurfelRadiance> shining(const mir::SurfelTree& tree) {
    mir::InlineExecutor executor;
    const auto light = [](const mir::SurfelFace& face, std::uint64_t number) {
        return number % 2 == 0 ? light_for(face, {1, 1, 1}) : mir::Rgb{};
    };
    return mir::light_surfels(mir::SurfelPatches(tree), light, 1e-4f, executor);
}

/// A point that gathers.
struct TestLuxel {
    mir::Hit hit;
    mir::Surface<mir::Lambert::Params> surface;
};

/// A white luxel, its position lifted already.
inline TestLuxel luxel(mir::Vec3 position, mir::Vec3 normal = {0, 1, 0}) {
    return {{position, normal}, {normal, normal, {}, {{1, 1, 1}}}};
}

}  // namespace mirtest
