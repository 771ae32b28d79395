// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/detail/cluster.hpp"

namespace mir::detail {

// Only the backend knows how many clusters are left. Kernels may be given more indices than that.

/// Kernel over clusters. Which of those up to `radius` places away is nearest, that is, has the
/// smallest box together with it. Of equally near ones i prefers the j for which the number i ^ j
/// is least: pairs that are equally good for both sides then find each other even where all
/// clusters are equal, and the best of all pairs always does.
struct FindNearest {
    const Cluster* clusters = nullptr;
    const std::uint32_t* left = nullptr;  ///< how many clusters there are
    std::uint32_t* partners = nullptr;
    std::uint32_t radius = 0;
    float area_scale = 0.0f;

    MIR_HD void operator()(std::uint32_t i) const {
        const std::uint32_t count = *left;
        if (i >= count) return;
        const Cluster mine = clusters[i];
        const std::uint32_t first = i < radius ? 0 : i - radius;
        const std::uint32_t end = count - i <= radius ? count : i + radius + 1;
        std::uint32_t best = i;
        float least = 0.0f;
        for (std::uint32_t j = first; j < end; ++j) {
            if (j == i) continue;
            const float area = area_with(mine, clusters[j]);
            if (best == i || area < least || (area == least && (i ^ j) < (i ^ best))) {
                best = j;
                least = area;
            }
        }
        partners[i] = best;
    }

 private:
    [[nodiscard]] MIR_HD float area_with(const Cluster& a, const Cluster& b) const {
        return half_area(lower_corner(a.low, b.low), upper_corner(a.high, b.high), area_scale);
    }
};

/// Kernel over clusters: the neighbour of the pair that they form by their order. The last of an
/// odd number has itself alone.
struct PairNeighbours {
    const std::uint32_t* left = nullptr;  ///< how many clusters there are
    std::uint32_t* partners = nullptr;

    MIR_HD void operator()(std::uint32_t i) const {
        if (i < *left) partners[i] = (i ^ 1u) < *left ? i ^ 1u : i;
    }
};

}  // namespace mir::detail
