// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/mesh.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace mir::detail {

/// Triangles from the vertex order of a primitive: lists, strips or fans (glTF 2.0, 3.7.2.1).
/// @pre `mode` is one of the three.
inline std::vector<TriangleIndices> gltf_triangles(const std::vector<std::uint32_t>& order,
                                                   int mode) {
    std::vector<TriangleIndices> triangles;
    const std::size_t n = order.size();
    if (n < 3) return triangles;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        triangles.reserve(n / 3);
        for (std::size_t i = 0; i + 2 < n; i += 3)
            triangles.push_back({order[i], order[i + 1], order[i + 2]});
        return triangles;
    }
    triangles.reserve(n - 2);
    for (std::size_t i = 0; i + 2 < n; ++i)
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            triangles.push_back({order[i + 1], order[i + 2], order[0]});
        else
            triangles.push_back({order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
    return triangles;
}

/// Which vertices of its accessors a primitive has. Exporters let many primitives share accessors,
/// and none of them should hold all of these.
struct VertexChoice {
    std::uint64_t all = 0;              ///< vertices of the accessors
    std::vector<std::uint32_t> chosen;  ///< in their order; empty: all

    [[nodiscard]] std::uint64_t size() const { return chosen.empty() ? all : chosen.size(); }
};

/// The vertices that triangles use, when few of all are used.
inline std::vector<std::uint32_t> sorted_vertices(const std::vector<TriangleIndices>& triangles) {
    std::vector<std::uint32_t> used;
    used.reserve(3 * triangles.size());
    for (const TriangleIndices& t : triangles) used.insert(used.end(), t.begin(), t.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
}

/// The same when there may be as many as `all`.
inline std::vector<std::uint32_t> marked_vertices(const std::vector<TriangleIndices>& triangles,
                                                  std::uint64_t all) {
    std::vector<char> is_used(all, 0);
    for (const TriangleIndices& t : triangles)
        for (const std::uint32_t v : t) is_used[v] = 1;
    std::vector<std::uint32_t> used;
    if (std::find(is_used.begin(), is_used.end(), 0) == is_used.end()) return used;
    for (std::size_t v = 0; v < is_used.size(); ++v)
        if (is_used[v] != 0) used.push_back(static_cast<std::uint32_t>(v));
    return used;
}

/// Leaves vertices out that no triangle uses, and renumbers. Indices out of range are left for
/// check_mesh() to name.
inline VertexChoice choose_vertices(std::vector<TriangleIndices>& triangles, std::uint64_t all) {
    VertexChoice choice{all, {}};
    for (const TriangleIndices& t : triangles)
        for (const std::uint32_t v : t)
            if (v >= all) return choice;
    choice.chosen = 3 * triangles.size() < all / 8 ? sorted_vertices(triangles)
                                                   : marked_vertices(triangles, all);
    if (choice.chosen.empty()) return choice;
    const auto& chosen = choice.chosen;
    for (TriangleIndices& t : triangles)
        for (std::size_t k = 0; k < 3; ++k)
            t[k] = static_cast<std::uint32_t>(std::lower_bound(chosen.begin(), chosen.end(), t[k]) -
                                              chosen.begin());
    return choice;
}

}  // namespace mir::detail
