// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/core/warp.hpp"
#include "mir/paths/light_end.hpp"

namespace mir {

/// Meaning of each coordinate of primary sample space. Each role keeps its coordinates whatever the
/// technique, so that a small step changes a path a little.
namespace path_dimension {
inline constexpr std::uint32_t technique = 0;         ///< which technique draws the path
inline constexpr std::uint32_t film = 1;              ///< place on the film, two numbers
inline constexpr std::uint32_t lens = 3;              ///< place on the lens, two
inline constexpr std::uint32_t spread = 5;            ///< what a VPL's spread is drawn from, three
inline constexpr std::uint32_t light = 8;             ///< which light
inline constexpr std::uint32_t on_light = 9;          ///< place on it, two
inline constexpr std::uint32_t light_direction = 11;  ///< direction from it, two
inline constexpr std::uint32_t light_side = 13;       ///< which of its sides
/// Three numbers for the direction at the camera part's `i`-th vertex, i >= 1.
MIR_HD constexpr std::uint32_t eye_vertex(std::uint32_t i) { return 14 + 6 * (i - 1); }
/// And at the `i`-th surface of the light's part, i >= 1.
MIR_HD constexpr std::uint32_t light_vertex(std::uint32_t i) { return 17 + 6 * (i - 1); }
/// One past the last coordinate that any path uses.
inline constexpr std::uint32_t count = eye_vertex(max_path_edges + 1);
}  // namespace path_dimension

// Below, `u.at(d)` yields coordinate d in [0, 1) of whoever asks.

/// Coordinates d and d + 1.
template <class Numbers>
MIR_HD Vec2 pair_at(Numbers& u, std::uint32_t d) {
    const float x = u.at(d);
    return {x, u.at(d + 1)};
}

/// Begins a path at the camera: film, lens and x1. False when the ray leaves the scene.
template <class World, class Numbers>
MIR_HD bool start_at_camera(const World& world, Numbers& u, Path& path) {
    path.vertices.clear();
    path.film = pair_at(u, path_dimension::film);
    path.lens = {0.0f, 0.0f};
    if (world.camera.lens_radius > 0.0f) path.lens = pair_at(u, path_dimension::lens);
    const Ray ray = world.camera.ray(path.film, world.aspect, path.lens);
    PathVertex first;
    if (!world.hit_luxel(ray, path, first)) return false;
    path.vertices.push_back(first);
    return true;
}

/// True when the direction lies above a surface.
MIR_HD inline bool leaves(const PathVertex& at, Vec3 w) {
    return glm::dot(w, at.normal) > 0.0f && glm::dot(w, at.shading_normal) > 0.0f;
}

/// Extends a path from the camera to `edges` edges. x2 spreads light as a VPL does, so it is
/// sampled like one, whatever x1 is. False when a direction leads nowhere.
template <class World, class Numbers>
MIR_HD bool extend_from_eye(const World& world, Numbers& u, std::uint32_t edges, Path& path) {
    using B = typename World::Bsdf;
    while (path.edges() < edges) {
        const std::uint32_t i = path.edges();
        const PathVertex at = world.lit_side(path, i);
        if (B::is_black(world.params(at))) return false;
        const std::uint32_t d = path_dimension::eye_vertex(i);
        const Vec2 uv = pair_at(u, d);
        Vec3 w;
        if (i == 2) {
            w = Frame::around(at.shading_normal).to_world(square_to_cosine_hemisphere(uv));
        } else {
            const Vec3 to_eye = glm::normalize(path.position(i - 1) - at.position);
            const Vec3 wo = path.is_lit_behind(i) ? -to_eye : to_eye;
            w = B::sample(world.params(at), at.shading_normal, wo, uv, u.at(d + 2)).wi;
        }
        PathVertex next;
        if (!leaves(at, w) || !world.hit({at.position, w}, next)) return false;
        path.vertices.push_back(next);
    }
    return true;
}

/// The light's part of a path in the making. It grows from x_k towards the camera, in place: the
/// path has all its edges already, and those that connect both parts come last.
struct LightPart {
    Path& path;              ///< whole path; outlives this
    std::uint32_t size = 0;  ///< vertices so far

    /// Its i-th vertex, x_(k-i).
    [[nodiscard]] MIR_HD PathVertex& vertex(std::uint32_t i) const {
        return path.x(path.edges() - i);
    }
    /// Writes the next vertex towards the camera; the path must have room for it.
    MIR_HD void add(const PathVertex& v) { vertex(size++) = v; }
};

/// Extends a light's part, which holds at least x_k, to `count` vertices. False when a direction
/// leads nowhere.
template <class World, class Numbers>
MIR_HD bool extend_from_light(const World& world, Numbers& u, std::uint32_t count,
                              LightPart& part) {
    using B = typename World::Bsdf;
    for (; part.size < count; ++part.size) {
        const std::uint32_t n = part.size;
        const PathVertex& at = part.vertex(n - 1);
        PathVertex& next = part.vertex(n);
        if (n == 1) {
            const Vec2 uv = pair_at(u, path_dimension::light_direction);
            if (!world.hit_from_light(ray_from_light(world, at, part.path.light, uv), next))
                return false;
            continue;
        }
        const bool far = n == 2 && part.path.light.origin == LightOrigin::outside;
        const PathVertex& before = part.vertex(n - 2);
        const Vec3 to_light = far ? -before.normal : glm::normalize(before.position - at.position);
        const Vec3 wo = at.is_through ? -to_light : to_light;
        const std::uint32_t d = path_dimension::light_vertex(n - 1);
        const Vec2 uv = pair_at(u, d);
        const Vec3 w = B::sample(world.params(at), at.shading_normal, wo, uv, u.at(d + 2)).wi;
        if (!leaves(at, w) || !world.hit_from_light({at.position, w}, next)) return false;
    }
    return true;
}

/// Begins a light's part with a light chosen by power, for emission.
template <class World, class Numbers>
MIR_HD void start_at_light(const World& world, Numbers& u, LightPart& part) {
    const PlacedLightEnd placed =
        sample_light_start(world, u.at(path_dimension::light), pair_at(u, path_dimension::on_light),
                           u.at(path_dimension::light_side));
    part.add(placed.vertex);
    part.path.light = placed.end;
}

/// Closes a path, which holds the camera's part, with a light path of `count` vertices. False when
/// a direction leads nowhere.
template <class World, class Numbers>
MIR_HD bool attach_light_path(const World& world, Numbers& u, std::uint32_t count, Path& path) {
    path.vertices.resize(path.edges() + count);
    LightPart part{path};
    start_at_light(world, u, part);
    return extend_from_light(world, u, count, part);
}

/// Closes a camera's part with one light sample for its last vertex.
template <class World, class Numbers>
MIR_HD void attach_light_sample(const World& world, Numbers& u, Path& path) {
    const PlacedLightEnd placed =
        sample_light_end(world, u.at(path_dimension::light), pair_at(u, path_dimension::on_light),
                         path.vertices.back().position);
    path.vertices.push_back(placed.vertex);
    path.light = placed.end;
}

/// Closes a camera's part that has run into a lamp. False when its last vertex does not emit.
template <class World>
MIR_HD bool end_on_lamp(const World& world, Path& path) {
    return light_end_at(world, path.vertices.back(), path.light);
}

/// Closes a camera's part with `from_light` vertices from a light. 0, it has run into a lamp (never
/// into an environment, which has no surface); 1, a light sample; more, a light path. The edge that
/// connects them may be blocked.
template <class World, class Numbers>
MIR_HD bool close_path(const World& world, Numbers& u, std::uint32_t from_light, Path& path) {
    if (from_light == 0) return end_on_lamp(world, path);
    if (from_light == 1) {
        attach_light_sample(world, u, path);
        return true;
    }
    return attach_light_path(world, u, from_light, path);
}

/// Whether the edge from x_i to x_(i+1) is free, i >= 1.
template <class World>
MIR_HD_CALL bool edge_is_free(const World& world, const Path& path, std::uint32_t i) {
    const Vec3 from = world.lit_side(path, i).position;
    Vec3 to = path.position(i + 1);
    if (i + 1 == path.edges() && path.light.origin == LightOrigin::outside)
        to = world.lights.sphere.outside(from, -path.x(i + 1).normal);
    return world.visibility.visible(to, from);
}

}  // namespace mir
