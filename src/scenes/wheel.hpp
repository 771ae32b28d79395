// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/car_hull.hpp"
#include "scenes/solids.hpp"

#include <array>

namespace mir::builtin {

/// Section of a tyre of 0.335 m radius and 0.24 m width. As (distance from the axle, x), clockwise
/// from the inner bead on; between points `tread_begin` and `tread_end` it touches the road.
struct TyreSection {
    static constexpr std::uint32_t tread_begin = 12;  ///< first point of the tread
    static constexpr std::uint32_t tread_end = 40;    ///< one beyond its last point
    static constexpr std::uint32_t points = 64;       ///< of the whole section, which is closed

    /// Point `i`, which is less than `points`, metres.
    static Vec2 at(std::uint32_t i) {
        const float half = 0.12f;
        if (i >= 52) {  // inside, from bead to bead
            const float f = static_cast<float>(i - 52) / 12.0f;
            return {0.252f, 0.098f - 0.196f * f};
        }
        const float phi = pi * (1.0f - static_cast<float>(i) / 51.0f) * 1.12f - 0.06f * pi;
        const float c = std::cos(phi);
        const float s = std::sin(phi);
        const float round = std::sqrt(std::sqrt(fourth(c) + fourth(s)));
        return {0.268f + 0.067f * s / round, half * c / round};
    }
};

/// Tyre about the x axis with a tread of blocks. Four grooves around, and slanted cuts.
inline Mesh tyre(std::uint32_t rubber) {
    const std::uint32_t segments = 264;
    Mesh m = empty_mesh("tyre", rubber);
    for (std::uint32_t s = 0; s < segments; ++s) {
        const float phi = 2.0f * pi * static_cast<float>(s) / static_cast<float>(segments);
        for (std::uint32_t i = 0; i < TyreSection::points; ++i) {
            const Vec2 p = TyreSection::at(i);
            const bool tread = i >= TyreSection::tread_begin && i < TyreSection::tread_end;
            const bool around = i % 7 == 5;
            const bool across = (s + (i < 26 ? i : 51 - i) / 2) % 6 == 0;
            const float r = p.x - (tread && (around || across) ? 0.007f : 0.0f);
            m.positions.emplace_back(p.y, r * std::cos(phi), -r * std::sin(phi));
        }
    }
    connect(m, 0, TyreSection::points, segments, Wrap::both);
    return smooth(std::move(m));
}

/// A rounded bar from `from` to `to` in the plane of the wheel. `half` wide across it, `depth`
/// thick along the axle.
inline Mesh spoke(std::uint32_t metal, Vec3 from, Vec3 to, float half, float depth) {
    const Vec3 along = 0.5f * (to - from);
    const Vec3 across = half * glm::normalize(glm::cross(along, Vec3(1, 0, 0)));
    const Mat4 shape{Vec4(depth, 0, 0, 0), Vec4(across, 0), Vec4(along, 0),
                     Vec4(0.5f * (from + to), 1)};
    return cushion("spoke", metal, shape, 16, 12);
}

/// Rim with five pairs of spokes, hub and bolts; its face looks towards +x.
inline Mesh rim(std::uint32_t metal) {
    const std::array<Vec2, 12> barrel{{{0.225f, 0.085f},
                                       {0.228f, -0.09f},
                                       {0.245f, -0.102f},
                                       {0.262f, -0.108f},
                                       {0.262f, -0.100f},
                                       {0.248f, -0.094f},
                                       {0.236f, -0.08f},
                                       {0.236f, 0.08f},
                                       {0.250f, 0.096f},
                                       {0.264f, 0.102f},
                                       {0.264f, 0.112f},
                                       {0.244f, 0.106f}}};
    Mesh m = lathe("rim", metal, barrel, 160);
    append(m, cushion("hub", metal, placed({0.022f, 0.05f, 0.05f}, {0.075f, 0, 0}), 32, 16));
    for (std::uint32_t k = 0; k < 5; ++k) {
        const float phi = 2.0f * pi * static_cast<float>(k) / 5.0f;
        const auto point = [&](float r, float angle, float x) {
            return Vec3(x, r * std::cos(phi + angle), r * std::sin(phi + angle));
        };
        for (const float lean : {-0.21f, 0.21f})
            append(m, spoke(metal, point(0.035f, 2.0f * lean, 0.07f), point(0.237f, lean, 0.088f),
                            0.014f, 0.016f));
        append(m, cushion("bolt", metal,
                          placed({0.012f, 0.009f, 0.009f}, point(0.03f, 0.5f, 0.095f)), 10, 6));
    }
    return m;
}

/// Brake disc and caliper behind the rim.
inline Mesh brake(std::uint32_t metal) {
    const std::array<Vec2, 6> disc{{{0.05f, 0.02f},
                                    {0.05f, -0.01f},
                                    {0.10f, -0.01f},
                                    {0.17f, -0.005f},
                                    {0.17f, 0.015f},
                                    {0.10f, 0.02f}}};
    Mesh m = lathe("brake", metal, disc, 96);
    append(m,
           cushion("caliper", metal, placed({0.035f, 0.05f, 0.09f}, {0.0f, 0.03f, 0.15f}), 24, 12));
    return m;
}

}  // namespace mir::builtin
