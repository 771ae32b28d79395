// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"
#include "scenes/solids.hpp"

#include <initializer_list>
#include <utility>
#include <vector>

namespace mir::builtin {

/// Smooth metal: a perfect mirror of the given reflectance at normal incidence.
inline Material mirror(std::string name, Rgb reflectance) {
    Material m;
    m.name = std::move(name);
    m.base_color = reflectance;
    m.metallic = 1.0f;
    m.roughness = 0.0f;
    return m;
}

/// Clear glass without thickness, such as a window pane.
inline Material pane_glass(std::string name) {
    Material m;
    m.name = std::move(name);
    m.base_color = {1.0f, 1.0f, 1.0f};
    m.roughness = 0.0f;
    m.transmission = 1.0f;
    return m;
}

/// Interface between a clear body (behind the front) and what has `ior` times less index.
inline Material body_glass(std::string name, float ior) {
    Material m = pane_glass(std::move(name));
    m.is_thin = false;
    m.ior = ior;
    return m;
}

/// Line of (distance from the axis, height): a part of an outline that is smooth in itself.
using Outline = std::vector<Vec2>;

/// Adds the surface that a line sweeps around the vertical through the origin. The front lies to
/// the right of the line. Points at distance 0 become one vertex.
inline void add_turned(Mesh& m, const Outline& line, std::uint32_t segments) {
    Mesh part = empty_mesh("", m.material);
    const auto is_pole = [&](std::size_t k) { return line[k].x == 0.0f; };
    std::vector<std::uint32_t> first;
    for (std::size_t k = 0; k < line.size(); ++k) {
        first.push_back(static_cast<std::uint32_t>(part.positions.size()));
        for (std::uint32_t s = 0; s < (is_pole(k) ? 1 : segments); ++s) {
            const float phi = 2.0f * pi * static_cast<float>(s) / static_cast<float>(segments);
            part.positions.emplace_back(line[k].x * std::cos(phi), line[k].y,
                                        -line[k].x * std::sin(phi));
        }
    }
    for (std::size_t k = 0; k + 1 < line.size(); ++k)
        for (std::uint32_t s = 0; s < segments; ++s) {
            const std::uint32_t next = (s + 1) % segments;
            const std::uint32_t a = first[k];
            const std::uint32_t b = first[k + 1];
            if (!is_pole(k))
                part.triangles.push_back({a + s, a + next, is_pole(k + 1) ? b : b + s});
            if (!is_pole(k + 1))
                part.triangles.push_back({b + next, b + s, is_pole(k) ? a : a + next});
        }
    append(m, smooth(std::move(part)));
}

/// Solid of revolution around the vertical through `base`. Edges between outlines are sharp.
inline Mesh turned_solid(std::string name, std::uint32_t material, Vec3 base,
                         std::initializer_list<Outline> outlines, std::uint32_t segments) {
    Mesh m = empty_mesh(std::move(name), material);
    for (const Outline& line : outlines) add_turned(m, line, segments);
    return moved(std::move(m), base);
}

}  // namespace mir::builtin
