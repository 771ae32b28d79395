// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"
#include "mir/scene/shapes.hpp"

namespace mir::builtin {

// Scenes whose light is known in closed form (docs/method.md, 9).

/// The furnace: a closed box of 2 m seen from its centre. Every wall has the same reflectance and
/// emission, so the radiance is emission / (1 - reflectance) everywhere.
inline Scene furnace_box(float reflectance = 0.5f, float emission = 0.5f) {
    Scene s;
    s.name = "furnace";
    const Rgb rho{reflectance, reflectance, reflectance};
    const std::uint32_t wall = s.add(emitter("wall", rho, {emission, emission, emission}));
    s.place(inside_out(box("box", wall, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2})));
    s.cameras.push_back(Camera::look_at({0, 0, 0}, {0.3f, 0.2f, -1.0f}, {0, 1, 0}, 1.2f));
    s.cameras.back().name = "centre";
    s.cameras.back().aspect_ratio = 1.0f;
    return s;
}

/// Unit square emitter of radiance 1, 1 m above a white square receiver. Mean irradiance
/// of the receiver: pi F with F = 0.199824896. The camera looks down from beside the
/// emitter.
inline Scene parallel_squares() {
    Scene s;
    s.name = "parallel-squares";
    const std::uint32_t receiver = s.add(lambertian("receiver", {1, 1, 1}));
    const std::uint32_t lamp = s.add(emitter("lamp", {0, 0, 0}, {1, 1, 1}));
    s.place(quad("receiver", receiver, {-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1}));
    s.place(quad("lamp", lamp, {-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}));
    s.cameras.push_back(Camera::look_at({1.5f, 1.2f, 0}, {0, 0, 0}, {0, 1, 0}, 0.6f));
    s.cameras.back().name = "side";
    s.cameras.back().aspect_ratio = 1.0f;
    return s;
}

/// Two unit squares that share an edge at a right angle. One is an emitter of radiance 1. Mean
/// irradiance of the other: pi F with F = 0.200043776.
inline Scene perpendicular_squares() {
    Scene s;
    s.name = "perpendicular-squares";
    const std::uint32_t receiver = s.add(lambertian("receiver", {1, 1, 1}));
    const std::uint32_t lamp = s.add(emitter("lamp", {0, 0, 0}, {1, 1, 1}));
    s.place(quad("receiver", receiver, {-0.5f, 0, 1}, {1, 0, 0}, {0, 0, -1}));
    s.place(quad("lamp", lamp, {-0.5f, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    s.cameras.push_back(Camera::look_at({0, 1.5f, 2.0f}, {0, 0, 0.5f}, {0, 1, 0}, 0.6f));
    s.cameras.back().name = "front";
    s.cameras.back().aspect_ratio = 1.0f;
    return s;
}

/// Disc of radius `radius` and radiance 1 above the centre of a receiver. At height `height` above
/// the small receiver the irradiance below its centre is pi radius^2 / (radius^2 + height^2).
inline Scene disc_above_plane(float radius = 1.0f, float height = 1.0f) {
    Scene s;
    s.name = "disc-above-plane";
    const std::uint32_t receiver = s.add(lambertian("receiver", {1, 1, 1}));
    const std::uint32_t lamp = s.add(emitter("lamp", {0, 0, 0}, {1, 1, 1}));
    s.place(quad("receiver", receiver, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}));
    s.place(disc("lamp", lamp, {0, height, 0}, {0, -1, 0}, {1, 0, 0}, radius, 256));
    s.cameras.push_back(Camera::look_at({3, 0.6f, 0}, {0, 0, 0}, {0, 1, 0}, 0.7f));
    s.cameras.back().name = "side";
    s.cameras.back().aspect_ratio = 1.0f;
    return s;
}

}  // namespace mir::builtin
