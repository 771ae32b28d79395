// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/construction.hpp"
#include "mir/accel/wide/detail/split_planes.hpp"
#include "mir/accel/wide/wide_options.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>

namespace mir::detail {

// No tree is deeper than its plan says. Each round of clustering adds one node at most to any way
// through the binary tree. A round that joins neighbours two by two halves the clusters, one that
// looks for the nearest joins two of them at least. Let r be the rounds done, m the clusters left
// and D the plan's max_depth. Claim: r + ceil(log2 m) <= 3 D. It holds at first, by the choice of
// D; joining two by two keeps it, and the nearest are looked for only if
// r + 1 + ceil(log2(m - 1)) <= 3 D. It is as true of an m that is more than there are. So the
// binary tree has a height of 3 D at most, there are no more rounds than that, and
// wide_children.hpp makes no way through the wide tree longer than D.

/// Least k with 2^k >= n; n at least 1.
inline std::uint32_t ceil_log2(std::uint32_t n) {
    return static_cast<std::uint32_t>(std::bit_width(n - 1u));
}

/// What all kernels of one construction share.
struct ClusterPlan {
    std::uint32_t triangles = 0;
    std::uint32_t references = 0;  ///< to triangles: leaves of the binary tree
    std::uint32_t splits = 0;      ///< of triangles, at most
    std::uint32_t leaf_size = 0;
    std::uint32_t radius = 0;
    float node_cost = 0.0f;
    std::uint32_t max_depth = 0;  ///< of the wide tree, nodes
    float magnitude = 0.0f;       ///< magnitude_of() the scene's bounds, metres
    float reach = 0.0f;           ///< metres
    Vec3 low{0};                  ///< of the scene's bounds, metres
    float to_unit = 0.0f;         ///< 1 / metres: turns the scene's largest extent into 1
    float area_scale = 0.0f;      ///< 1 / metres: keeps surfaces from overflowing
    SplitPlanes planes;           ///< at which triangles are split

    /// Makes it a plan for so many references.
    void hold(std::uint32_t count) {
        references = count;
        max_depth = std::max({max_depth, (ceil_log2(room()) + 2) / 3, 1u});
    }

    /// References for which to keep memory.
    [[nodiscard]] std::uint32_t room() const { return std::max(references, 1u); }

    /// Whether a round may look for the nearest of at most that many clusters. They are at least 2;
    /// see above.
    [[nodiscard]] bool may_search(std::uint32_t rounds, std::uint32_t clusters) const {
        return rounds + 1 + ceil_log2(clusters - 1) <= 3 * max_depth;
    }
};

/// 1 / length, but finite.
inline float finite_inverse(float length) { return smaller(1.0f / length, 0x1p120f); }

/// Checks that 32 bits count the binary tree's nodes. A triangle is split once on average at
/// most.
/// @throws Error(limit_exceeded)
inline void check_triangle_count(std::size_t triangles, const WideBvhOptions& options) {
    if (triangles < std::size_t{1} << (options.splits > 0.0f ? 30 : 31)) return;
    throw Error(ErrorCode::limit_exceeded,
                "the scene has " + std::to_string(triangles) +
                    " triangles (their tree would have more nodes than 32 bits count); leave "
                    "some out");
}

/// Of so many triangles of a scene.
/// @throws Error(invalid_argument) on options out of range; Error(invalid_input) on coordinates
///         beyond 1e36 metres; Error(limit_exceeded) on 2^31 triangles and more, 2^30 where
///         they are to be split.
inline ClusterPlan cluster_plan(const WorldGeometry& geometry, std::uint32_t triangles,
                                const WideBvhOptions& options) {
    check(options);
    check_coordinates(geometry);
    check_triangle_count(geometry.triangles().size(), options);
    const Bounds& bounds = geometry.bounds();
    ClusterPlan plan;
    plan.triangles = triangles;
    plan.splits = static_cast<std::uint32_t>(static_cast<double>(options.splits) * plan.triangles);
    plan.leaf_size = options.leaf_size;
    plan.radius = options.radius;
    plan.node_cost = options.node_cost;
    plan.max_depth = options.max_depth;
    plan.hold(plan.triangles);
    plan.magnitude = magnitude_of(bounds);
    plan.reach = reach_of(plan.magnitude);
    if (bounds.empty()) return plan;
    const float widest = max_abs(bounds.high - bounds.low);
    plan.low = bounds.low;
    plan.planes = split_planes(bounds.low, widest);
    plan.to_unit = finite_inverse(widest);
    // No accept box is smaller than 2^-18 of the magnitude, however small its triangle.
    plan.area_scale = finite_inverse(larger(widest, 0x1p-18f * plan.magnitude));
    return plan;
}

}  // namespace mir::detail
