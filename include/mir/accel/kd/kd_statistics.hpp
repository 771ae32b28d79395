// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace mir {

/// What a kd-tree looks like and what it took to build it.
struct KdTreeStatistics {
    std::uint64_t triangles = 0;     ///< of the scene, without those that have no area
    std::uint64_t nodes = 0;         ///< inner nodes and leaves
    std::uint64_t leaves = 0;        ///< empty ones included
    std::uint64_t empty_leaves = 0;  ///< without a triangle
    std::uint64_t references = 0;    ///< triangles listed in all leaves together
    std::uint32_t depth = 0;         ///< of the deepest leaf; 0 when the root is one
    std::uint32_t largest_leaf = 0;  ///< triangles
    double sah_cost = 0.0;    ///< expected cost of a line through the root's box, in triangle tests
    std::uint64_t bytes = 0;  ///< of nodes, references and triangle rows

    double prepare_seconds = 0.0;   ///< triangle rows, accept regions
    double top_seconds = 0.0;       ///< nodes too large for one thread
    double subtrees_seconds = 0.0;  ///< everything below
    double assemble_seconds = 0.0;  ///< into one array

    /// Of all stages.
    [[nodiscard]] double seconds() const {
        return prepare_seconds + top_seconds + subtrees_seconds + assemble_seconds;
    }
    /// Leaves that list a triangle, on average; 0 for a scene without triangles.
    [[nodiscard]] double references_per_triangle() const { return ratio(references, triangles); }
    /// Mean number of triangles of leaves that have some.
    [[nodiscard]] double triangles_per_leaf() const {
        return ratio(references, leaves - empty_leaves);
    }
    /// Memory held per triangle; 0 for a scene without triangles.
    [[nodiscard]] double bytes_per_triangle() const { return ratio(bytes, triangles); }

 private:
    static double ratio(std::uint64_t a, std::uint64_t b) {
        return b == 0 ? 0.0 : static_cast<double>(a) / static_cast<double>(b);
    }
};

}  // namespace mir
