// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"
#include "support/backwards_executor.hpp"

#include <cstring>
#include <span>
#include <vector>

// Scenes that are hard to build trees over, and what tests of builders share.

namespace mirtest {

inline World world_of(mir::Mesh mesh) {
    mir::Scene scene;
    mesh.material = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(std::move(mesh));
    return World(std::move(scene));
}

/// Triangles with one corner far from the two others, which are 1 / aspect as far apart.
inline World needles(std::uint32_t count, float aspect, std::uint64_t index, float scale = 1.0f) {
    mir::Random random = test_random(index);
    mir::Mesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const mir::Vec3 a = point_in_cube(random);
        const mir::Vec3 along = direction(random);
        const mir::Vec3 side = glm::normalize(glm::cross(along, direction(random)));
        mesh.positions.push_back(scale * a);
        mesh.positions.push_back(scale * (a + along));
        mesh.positions.push_back(scale * (a + side / aspect));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return world_of(std::move(mesh));
}

/// A square of `side` x `side` cells of two triangles, flat in the axis of `normal`.
inline World flat_grid(std::uint32_t side, int normal) {
    mir::Mesh mesh;
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        mir::Vec3 p(0.25f);
        p[(normal + 1) % 3] = static_cast<float>(i);
        p[(normal + 2) % 3] = static_cast<float>(j);
        return p;
    };
    for (std::uint32_t i = 0; i <= side; ++i)
        for (std::uint32_t j = 0; j <= side; ++j) mesh.positions.push_back(at(i, j));
    for (std::uint32_t i = 0; i < side; ++i)
        for (std::uint32_t j = 0; j < side; ++j) {
            const std::uint32_t v = i * (side + 1) + j;
            mesh.triangles.push_back({v, v + 1, v + side + 1});
            mesh.triangles.push_back({v + 1, v + side + 2, v + side + 1});
        }
    return world_of(std::move(mesh));
}

/// The same triangle `count` times.
inline World coincident(std::uint32_t count) {
    mir::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0.5f, 0}, {0.25f, 1, 1}};
    mesh.triangles.assign(count, {0, 1, 2});
    return world_of(std::move(mesh));
}

/// Triangles that become smaller towards the origin, `per_octave` of them before they are half as
/// large: every level of a tree parts off a few.
inline World nested_triangles(std::uint32_t count, int per_octave) {
    mir::Mesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const float s = std::ldexp(1.0f, -static_cast<int>(i) / per_octave);
        for (mir::Vec3 p : {mir::Vec3(1, 0, 0), mir::Vec3(0, 1, 0), mir::Vec3(0, 0, 1)})
            mesh.positions.push_back(s * p);
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return world_of(std::move(mesh));
}

template <class T>
bool equal_bytes(std::span<const T> a, std::span<const T> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

}  // namespace mirtest
