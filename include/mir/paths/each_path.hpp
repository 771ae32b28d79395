// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/core/random.hpp"
#include "mir/paths/path_generator.hpp"

#include <algorithm>

namespace mir {

/// Independent paths first to end - 1. Path i is a function of Random(seed, stream, i).
struct PathRange {
    std::uint64_t seed = 0;             ///< of all paths
    Stream stream = Stream::bootstrap;  ///< what the paths are for
    std::uint64_t first = 0;            ///< index of the first path
    std::uint64_t end = 0;              ///< one past the last, at least `first`
};

/// Calls f(i, path) for each path of the range, from many threads. `generator` builds them, those
/// of weight 0 included; the order is free. `f` may write what belongs to i.
template <class Generator, Executor E, class F>
void each_path(const Generator& generator, PathRange range, E& executor, const F& f) {
    constexpr std::uint64_t batch = 256;
    executor.for_each((range.end - range.first + batch - 1) / batch, [&](std::size_t b) {
        WeightedPath path;
        const std::uint64_t begin = range.first + b * batch;
        for (std::uint64_t i = begin; i < std::min(begin + batch, range.end); ++i) {
            generator.generate(NearbyNumbers(Random(range.seed, range.stream, i)), path);
            f(i, path);
        }
    });
}

}  // namespace mir
