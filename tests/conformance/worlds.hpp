// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/validation/worlds.hpp"

#include <utility>

namespace mirtest {

using mir::validation::random_surface_point;
using mir::validation::triangle_soup;
using mir::validation::World;
using mir::validation::detail::direction;
using mir::validation::detail::point_in_cube;

/// Random numbers of tests; `index` keeps tests apart.
inline mir::Random test_random(std::uint64_t index) { return {20090401, mir::Stream::test, index}; }

/// A closed sphere of radius 0.5 inside a closed box of edge 2, flat to shared edges everywhere.
/// The sphere has a number of slices round its axis and half as many stacks along it.
inline World sphere_in_box(std::uint32_t slices = 12) {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(mir::builtin::inside_out(
        mir::builtin::box("box", grey, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2})));
    scene.place(mir::builtin::sphere("sphere", grey, {0, 0, 0}, 0.5f, slices, slices / 2));
    return World(std::move(scene));
}

}  // namespace mirtest
