// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/core/random.hpp"
#include "mir/core/warp.hpp"
#include "mir/scene/builtin/shapes.hpp"
#include "mir/scene/scene.hpp"
#include "mir/scene/world_geometry.hpp"

#include <utility>

namespace mirtest {

/// A scene together with its triangles in world space.
struct World {
    mir::Scene scene;
    mir::WorldGeometry geometry;

    explicit World(mir::Scene s) : scene(std::move(s)), geometry(scene) {}
};

/// Random numbers of tests; `index` keeps tests apart.
inline mir::Random test_random(std::uint64_t index) { return {20090401, mir::Stream::test, index}; }

/// Uniform in the cube [-1, 1]^3.
inline mir::Vec3 point_in_cube(mir::Random& random) {
    const float x = random.next();
    const float y = random.next();
    return 2.0f * mir::Vec3(x, y, random.next()) - 1.0f;
}

/// Uniform over directions.
inline mir::Vec3 direction(mir::Random& random) { return mir::square_to_sphere(random.next_2d()); }

/// `count` triangles with random corners, each in a cube of edge 0.5 inside [-1.25, 1.25]^3, then
/// scaled and moved.
inline World triangle_soup(std::uint32_t count, std::uint64_t index, float scale = 1.0f,
                           mir::Vec3 move = {0, 0, 0}) {
    mir::Random random = test_random(index);
    mir::Mesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const mir::Vec3 centre = point_in_cube(random);
        for (int k = 0; k < 3; ++k)
            mesh.positions.push_back(move + scale * (centre + 0.25f * point_in_cube(random)));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    mir::Scene scene;
    mesh.material = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(std::move(mesh));
    return World(std::move(scene));
}

/// A closed sphere of radius 0.5 inside a closed box of edge 2, flat to shared edges everywhere.
inline World sphere_in_box() {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(mir::builtin::inside_out(
        mir::builtin::box("box", grey, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2})));
    scene.place(mir::builtin::sphere("sphere", grey, {0, 0, 0}, 0.5f, 12, 6));
    return World(std::move(scene));
}

/// A point on a random triangle, seen from a random side.
inline mir::SurfacePoint random_surface_point(const mir::WorldGeometry& geometry,
                                              mir::Random& random) {
    const auto count = static_cast<float>(geometry.triangles().size());
    const auto triangle = static_cast<std::uint32_t>(random.next() * count);
    const mir::Vec2 uv = mir::square_to_triangle(random.next_2d());
    return geometry.surface_point(triangle, uv, direction(random));
}

}  // namespace mirtest
