// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/car_hull.hpp"
#include "scenes/sheet.hpp"

#include <array>
#include <initializer_list>

namespace mir::builtin {

/// A line across a panel. In the coordinates (a, b) of a Core or (x, z) of a deck.
struct Rib {
    Vec2 low{0};   ///< lower end
    Vec2 high{0};  ///< upper end
};

/// Grid of parameters between ribs, cells about `cell` metres wide. A loop ends where it starts.
inline SurfaceGrid parameters(std::span<const Rib> ribs, float cell, bool loop) {
    float longest = 0.0f;
    for (const Rib& rib : ribs) longest = larger(longest, glm::length(rib.high - rib.low));
    SurfaceGrid g;
    g.loop = loop;
    g.rows = 1 + static_cast<std::uint32_t>(larger(2.0f, longest / cell));
    std::vector<Rib> columns;
    for (std::size_t i = 0; i + 1 < ribs.size(); ++i) {
        const float span = larger(glm::length(ribs[i + 1].low - ribs[i].low),
                                  glm::length(ribs[i + 1].high - ribs[i].high));
        const auto steps = static_cast<std::uint32_t>(std::ceil(span / cell));
        for (std::uint32_t k = 0; k < steps; ++k) {
            const float f = static_cast<float>(k) / static_cast<float>(steps);
            columns.push_back({glm::mix(ribs[i].low, ribs[i + 1].low, f),
                               glm::mix(ribs[i].high, ribs[i + 1].high, f)});
        }
    }
    if (!loop) columns.push_back(ribs.back());
    g.columns = static_cast<std::uint32_t>(columns.size());
    for (std::uint32_t r = 0; r < g.rows; ++r)
        for (const Rib& c : columns) {
            const float up = static_cast<float>(r) / static_cast<float>(g.rows - 1);
            g.points.emplace_back(glm::mix(c.low, c.high, up), 0.0f);
        }
    return g;
}

/// How a panel is cut. Size of its cells, thickness and depth below the hull, metres.
struct Cut {
    float cell = 0.0226f;      ///< width of a cell, metres
    float thickness = 0.012f;  ///< metres
    float inset = 0.0f;        ///< depth of the front below the hull, metres
    bool loop = false;         ///< the panel goes around and closes on itself
};

/// Part of a hull's side between ribs in (a, b) of its core.
template <class Hull>
Mesh side_panel(std::string name, std::uint32_t material, const Core& core, const Hull& hull,
                const std::vector<Rib>& ribs, const Cut& cut = {}) {
    SurfaceGrid g = parameters(ribs, cut.cell, cut.loop);
    for (Vec3& p : g.points) {
        const auto [origin, direction] = core.ray(Vec2(p.x, p.y));
        p = surface_along(hull, origin, direction);
    }
    return sheet(std::move(name), material, g, cut.thickness, cut.inset);
}

/// Part of a hull's top above the rectangle (x, z) from `low` to `high`.
template <class Hull>
Mesh deck_panel(std::string name, std::uint32_t material, float from_height, const Hull& hull,
                Vec2 low, Vec2 high, const Cut& cut = {}) {
    const std::array<Rib, 2> ribs{Rib{low, {low.x, high.y}}, Rib{{high.x, low.y}, high}};
    SurfaceGrid g = parameters(ribs, cut.cell, false);
    for (Vec3& p : g.points)
        p = surface_along(hull, Vec3(p.x, from_height, p.y), Vec3(0.0f, 1.0f, 0.0f));
    return sheet(std::move(name), material, g, cut.thickness, cut.inset);
}

/// Four-sided panel. `low` and `high` give its first and last `a` at heights `b0` and `b1`.
inline std::vector<Rib> strip(Vec2 low, Vec2 high, float b0, float b1) {
    return {{{low.x, b0}, {high.x, b1}}, {{low.y, b0}, {high.y, b1}}};
}

/// The same with upright ends at each of `a`.
inline std::vector<Rib> band(std::initializer_list<float> a, float b0, float b1) {
    std::vector<Rib> ribs;
    for (const float x : a) ribs.push_back({{x, b0}, {x, b1}});
    return ribs;
}

/// The panel around a wheel arch. From the arch to the rectangle [a0, a1] x [bottom, top].
inline std::vector<Rib> around_arch(float axle, float a0, float a1, float bottom, float top) {
    const float radius = 0.372f;
    const float height = car_wheel_height;
    std::vector<Rib> ribs{{{axle - radius, bottom}, {a0, bottom}}};
    const std::array<float, 4> corners{pi, std::atan2(top - height, a0 - axle),
                                       std::atan2(top - height, a1 - axle), 0.0f};
    for (std::size_t k = 0; k < 3; ++k)
        for (std::uint32_t i = k == 0 ? 0 : 1; i <= 16; ++i) {
            const float f = static_cast<float>(i) / 16.0f;
            const float angle = corners[k] + f * (corners[k + 1] - corners[k]);
            const Vec2 out(std::cos(angle), std::sin(angle));
            const float across = ((k == 0 ? a0 : a1) - axle) / out.x;
            const float reach = k == 1 ? (top - height) / out.y : across;
            const Vec2 centre(axle, height);
            ribs.push_back({centre + radius * out, centre + reach * out});
        }
    ribs.push_back({{axle + radius, bottom}, {a1, bottom}});
    return ribs;
}

}  // namespace mir::builtin
