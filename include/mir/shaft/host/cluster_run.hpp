// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace mir::detail {

/// Part of an order.
struct ClusterRun {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// Runs of this size are split no more: the smallest that anything decides at once.
inline constexpr std::size_t smallest_cluster = 16;

/// Elements of the first part of a run. The largest 16 2^k below its size, so that every aligned
/// run of that many luxels is one part of the recursion.
inline std::size_t first_part(std::size_t count) {
    std::size_t part = smallest_cluster;
    while (2 * part < count) part *= 2;
    return part;
}

}  // namespace mir::detail
