// SPDX-License-Identifier: MIT
#include "conformance/worlds.hpp"
#include "support/catch.hpp"

#include <array>

namespace {

using mir::Vec2;
using mir::Vec3;
using mirtest::Approx;
using mirtest::World;

/// A closed room whose corners are not quite at right angles, turned, and the same far away.
World skewed_room(float scale, Vec3 move) {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    const Vec3 a = scale * Vec3(2.0f, 0.3f, -0.4f);
    const Vec3 b = scale * Vec3(-0.2f, 2.0f, 0.5f);
    const Vec3 c = scale * Vec3(0.6f, -0.3f, 2.0f);
    scene.place(mir::builtin::inside_out(
        mir::builtin::box("room", grey, move - 0.5f * (a + b + c), a, b, c)));
    return World(std::move(scene));
}

/// Barycentrics on corners and edges, and beside them by some units of rounding.
std::vector<Vec2> border_places() {
    std::vector<Vec2> places{{0, 0}, {1, 0}, {0, 1}, {0.5f, 0.5f}, {0, 0.3f}, {0.7f, 0}};
    for (const float tiny : {1e-7f, 1e-5f, 1e-3f})
        for (const Vec2 at : {Vec2(tiny, tiny), Vec2(1.0f - 2.0f * tiny, tiny), Vec2(tiny, 0.4f),
                              Vec2(0.3f, 0.7f - tiny)})
            places.push_back(at);
    return places;
}

/// Least distance of a point from the planes of the triangles, on the side of their fronts.
double least_height(const mir::WorldGeometry& g, Vec3 p) {
    using Double3 = glm::dvec3;
    double least = 1e30;
    for (std::uint32_t t = 0; t < g.triangles().size(); ++t) {
        const Double3 corner(g.corner(t, 0));
        const Double3 n =
            glm::cross(Double3(g.corner(t, 1)) - corner, Double3(g.corner(t, 2)) - corner);
        least = std::min(least, glm::dot(glm::normalize(n), Double3(p) - corner));
    }
    return least;
}

/// A room of two metres; a plane of some size lies 0.1 m below it.
World room_over_plane(float size) {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(mir::builtin::inside_out(
        mir::builtin::box("room", grey, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2})));
    scene.place(mir::builtin::quad("plane", grey, {-size, -0.1f, size}, {2.0f * size, 0, 0},
                                   {0, 0, -2.0f * size}));
    return World(std::move(scene));
}

}  // namespace

TEST_CASE("Lifted points lie before every wall of a closed room, at its edges too") {
    const auto [scale, x] = GENERATE(table<float, float>(
        {{1.0f, 0.0f}, {1e-6f, 0.0f}, {1e6f, 0.0f}, {1.0f, 100.0f}, {0.01f, 30.0f}}));
    INFO("scale " << scale << ", moved by " << x);
    const World room = skewed_room(scale, {x, 0.3f * x, -x});
    const mir::WorldGeometry& g = room.geometry;
    for (std::uint32_t t = 0; t < g.triangles().size(); ++t)
        for (const Vec2 at : border_places()) {
            const mir::SurfacePoint p = g.surface_point(t, at, -g.front_normal(t));
            // What hits_segment() needs to know the side of a plane: 12.2 units of rounding.
            const double needed = 12.2 * 0x1p-24 * static_cast<double>(mir::max_abs(p.position));
            CHECK(least_height(g, mir::lift(p)) > needed);
        }
}

TEST_CASE("Points are moved off edges by little, and not at all elsewhere") {
    const World room = skewed_room(1.0f, {0, 0, 0});
    const auto view = room.geometry.view();
    for (std::uint32_t t = 0; t < room.geometry.triangles().size(); ++t) {
        const Vec2 inside(0.25f, 0.5f);
        CHECK(view.place(t, inside, view.ray_offset) == view.position(t, inside));
        for (const Vec2 at : border_places())
            CHECK(glm::length(view.place(t, at, view.ray_offset) - view.position(t, at)) <
                  20.0f * view.ray_offset);
    }
}

TEST_CASE("Narrow triangles keep their points within them") {
    mir::Scene scene;
    mir::Mesh mesh;
    mesh.material = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.4f, 1e-6f, 0}};
    mesh.triangles = {{0, 1, 2}};
    scene.place(std::move(mesh));
    const mir::WorldGeometry g(scene);
    const Vec3 p = g.view().place(0, {0.5f, 0.0f}, g.ray_offset());
    CHECK(p.x == Approx(0.5f));
    CHECK(p.y == Approx(0.25e-6f));
}

TEST_CASE("Points of a room are not lifted farther because of what lies around it") {
    const World alone = room_over_plane(1.0f);
    const World wide = room_over_plane(5000.0f);
    const mir::Ray ray{{0, 1, 0}, {0, -1, 0}};
    const mir::SurfacePoint near = alone.geometry.surface_point(2, {0.3f, 0.3f}, ray);
    const mir::SurfacePoint same = wide.geometry.surface_point(2, {0.3f, 0.3f}, ray);
    CHECK(near.offset > 0.0f);
    CHECK(same.offset < 5.0f * near.offset);
    CHECK(same.offset < 2e-4f);
    // Nor do points of the plane itself leave it by more than rounding at the place.
    const std::uint32_t plane = 12;
    const Vec3 p = wide.geometry.view().position(plane, {0.500001f, 0.2499f});
    CHECK(std::fabs(p.y + 0.1f) <= 1e-8f);
}
