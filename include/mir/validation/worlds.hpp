// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"
#include "mir/scene/world_geometry.hpp"
#include "mir/validation/detail/random.hpp"

#include <algorithm>
#include <utility>

namespace mir::validation {

/// A scene together with its triangles in world space.
struct World {
    Scene scene;             ///< what `geometry` was made of
    WorldGeometry geometry;  ///< its triangles

    /// @throws What WorldGeometry throws of the scene.
    explicit World(Scene s) : scene(std::move(s)), geometry(scene) {}
};

/// `count` triangles with random corners, then scaled and moved. Before that each lies in a cube of
/// edge 0.5 inside [-1.25, 1.25]^3.
inline World triangle_soup(std::uint32_t count, std::uint64_t index, float scale = 1.0f,
                           Vec3 move = {0, 0, 0}) {
    Random random = detail::numbers(index);
    Mesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 centre = detail::point_in_cube(random);
        for (int k = 0; k < 3; ++k)
            mesh.positions.push_back(move +
                                     scale * (centre + 0.25f * detail::point_in_cube(random)));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    Scene scene;
    mesh.material = scene.add(lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(std::move(mesh));
    return World(std::move(scene));
}

/// A point on a random triangle, seen from a random side. There must be a triangle.
inline SurfacePoint random_surface_point(const WorldGeometry& geometry, Random& random) {
    const auto count = static_cast<float>(geometry.triangles().size());
    const auto triangle = static_cast<std::uint32_t>(random.next() * count);
    const Vec2 uv = square_to_triangle(random.next_2d());
    return geometry.surface_point(triangle, uv, detail::direction(random));
}

}  // namespace mir::validation
