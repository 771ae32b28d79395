// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <cstdint>

namespace mir {

/// How a kd-tree is built. Choices change speed and memory, never what is visible.
struct KdTreeOptions {
    /// Deepest leaf that any tree may have; traversal has a stack of that size.
    static constexpr std::uint32_t depth_limit = 64;

    /// Choices for traversal on a GPU, one ray per thread. There an inner node costs less beside a
    /// triangle than in the packets of the host (docs/decisions/023 has the sweep).
    [[nodiscard]] static KdTreeOptions for_gpu() {
        KdTreeOptions options;
        options.traversal_cost = 0.75f;
        return options;
    }

    float traversal_cost = 1.5f;     ///< of one inner node; > 0
    float intersection_cost = 1.0f;  ///< of one triangle, in the same unit; > 0
    float empty_bonus = 0.0f;        ///< share of the cost that a plane saves which cuts off empty
                                     ///< space; 0 <= bonus < 1
    std::uint32_t max_depth = 0;     ///< 0: 8 + 1.3 log2(triangles), at most depth_limit
    std::uint64_t max_references = 0xFFFFFFFFull;  ///< triangles listed in all leaves together

    /// Cost of an inner node in triangle tests.
    [[nodiscard]] float visit_cost() const { return traversal_cost / intersection_cost; }
};

/// @throws Error(invalid_argument) when an option is out of its range.
inline void check(const KdTreeOptions& options) {
    expects(options.traversal_cost > 0.0f && options.traversal_cost < 1e6f &&
                options.intersection_cost > 0.0f && options.intersection_cost < 1e6f,
            "a cost of the kd-tree is not between 0 and a million (the surface area heuristic "
            "compares them); choose positive costs");
    expects(options.empty_bonus >= 0.0f && options.empty_bonus < 1.0f,
            "the kd-tree's bonus for empty space is a share of a cost and must lie in [0, 1); "
            "choose one there");
    expects(options.max_depth <= KdTreeOptions::depth_limit,
            "the kd-tree's max_depth exceeds the stack of its traversal; choose at most 64, or 0 "
            "for a depth by the number of triangles");
    expects(options.max_references > 0 && options.max_references <= 0xFFFFFFFFull,
            "the kd-tree's max_references must be at least 1 and fit into 32 bits; choose one "
            "there");
}

}  // namespace mir
