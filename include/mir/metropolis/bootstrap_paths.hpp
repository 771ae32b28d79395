// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/paths/path_generator.hpp"
#include "mir/paths/path_place.hpp"

namespace mir {

/// One path of the bootstrap. Kernel over a batch: index i is the path that `generator` builds from
/// Random(seed, Stream::bootstrap, first + i). A thread needs 6 kB of its own for it.
template <class Generator>
struct BootstrapPaths {
    Generator generator;              ///< of all paths
    std::uint64_t seed = 0;           ///< of the run
    std::uint64_t first = 0;          ///< path that index 0 stands for
    double* weights = nullptr;        ///< of the batch
    std::uint32_t* places = nullptr;  ///< place_of_vpl(), 0 without light

    /// Path first + i, in memory of the thread's own.
    MIR_HD void operator()(std::uint32_t i) const {
        WeightedPath path;
        draw(i, path);
    }

    /// The same with memory for the path, which may be used again.
    MIR_HD void draw(std::uint32_t i, WeightedPath& path) const {
        generator.generate(NearbyNumbers(Random(seed, Stream::bootstrap, first + i)), path);
        weights[i] = path.weight;
        places[i] = path.weight > 0.0
                        ? static_cast<std::uint32_t>(place_of_vpl(generator.world(), path.path))
                        : 0;
    }
};

}  // namespace mir
