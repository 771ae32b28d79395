// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/solids.hpp"

#include <span>
#include <vector>

namespace mir::builtin {

/// Points of a surface, row by row. The front is where (next row) x (next column) points.
struct SurfaceGrid {
    std::uint32_t columns = 0;  ///< vertices in a row, at least 2
    std::uint32_t rows = 0;     ///< at least 2
    bool loop = false;          ///< the last column is followed by the first
    std::vector<Vec3> points;   ///< columns x rows, metres

    /// The vertex of column `c` and row `r`, unchecked.
    [[nodiscard]] Vec3 at(std::uint32_t c, std::uint32_t r) const {
        return points[r * columns + c];
    }

    /// Unit normal of the front at a vertex, from its neighbours.
    [[nodiscard]] Vec3 normal(std::uint32_t c, std::uint32_t r) const {
        const std::uint32_t left = c > 0 ? c - 1 : loop ? columns - 1 : c;
        const std::uint32_t right = c + 1 < columns ? c + 1 : loop ? 0 : c;
        const Vec3 along = at(right, r) - at(left, r);
        const Vec3 up = at(c, r + 1 < rows ? r + 1 : r) - at(c, r > 0 ? r - 1 : r);
        return glm::normalize(glm::cross(up, along));
    }
};

/// Vertices around the border of a grid, clockwise from its front. One line, or two when the grid
/// is a loop.
inline std::vector<std::vector<std::uint32_t>> border(const SurfaceGrid& g) {
    std::vector<std::uint32_t> low;
    std::vector<std::uint32_t> high;
    for (std::uint32_t c = 0; c < g.columns; ++c) {
        low.push_back(c);
        high.push_back((g.rows - 1) * g.columns + g.columns - 1 - c);
    }
    if (g.loop) return {low, high};
    for (std::uint32_t r = 1; r + 1 < g.rows; ++r) low.push_back(r * g.columns + g.columns - 1);
    low.insert(low.end(), high.begin(), high.end());
    for (std::uint32_t r = g.rows - 2; r > 0; --r) low.push_back(r * g.columns);
    return {low};
}

/// Joins front and back of a sheet along one line of its border. The edge has its own vertices.
inline void add_rim(Mesh& m, std::span<const std::uint32_t> line, std::uint32_t back) {
    const auto first = static_cast<std::uint32_t>(m.positions.size());
    for (const std::uint32_t side : {0u, back})
        for (const std::uint32_t v : line) {
            const Vec3 p = m.positions[v + side];
            m.positions.push_back(p);
        }
    connect(m, first, static_cast<std::uint32_t>(line.size()), 2, Wrap::columns);
}

/// Closed sheet with front, back and edges. The front is the grid lowered by `inset` along its
/// normals, the back lies `thickness` (metres) behind it. Front and back are smooth, edges are
/// sharp.
inline Mesh sheet(std::string name, std::uint32_t material, const SurfaceGrid& g, float thickness,
                  float inset = 0.0f) {
    Mesh m = empty_mesh(std::move(name), material);
    for (const float depth : {inset, inset + thickness})
        for (std::uint32_t r = 0; r < g.rows; ++r)
            for (std::uint32_t c = 0; c < g.columns; ++c)
                m.positions.push_back(g.at(c, r) - depth * g.normal(c, r));
    const Wrap wrap = g.loop ? Wrap::columns : Wrap::none;
    const std::uint32_t back = g.columns * g.rows;
    connect(m, 0, g.columns, g.rows, wrap);
    for (TriangleIndices& t : m.triangles) std::swap(t[1], t[2]);
    connect(m, back, g.columns, g.rows, wrap);
    for (const auto& line : border(g)) add_rim(m, line, back);
    return smooth(std::move(m));
}

}  // namespace mir::builtin
