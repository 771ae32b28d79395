// SPDX-License-Identifier: MIT
#pragma once

#include "mir/paths/each_path.hpp"
#include "mir/sampling/vpl_generator.hpp"

#include <numeric>

namespace mir {

/// The floor under the target of VplGenerator.
struct TargetFloor {
    /// Floor over the mean response, above 0 to 1. Share / (1 + share) of the VPLs are there for
    /// its sake. Small: light that the probe misses comes seldom and bright; large: more VPLs light
    /// nothing.
    float share = 0.05f;
    std::uint32_t pilot_paths = 4096;  ///< that estimate the mean response beforehand

    /// @throws Error(invalid_argument) when a value is out of range.
    void validate() const {
        expects(share > 0.0f && share <= 1.0f,
                "the floor of the target must be above 0 (else light that the probe misses is lost "
                "and the image is biased) and at most 1; use 0.05");
        expects(pilot_paths > 0, "the pilot of the target must have at least 1 path");
    }
};

/// The generator with a floor of `share` times the mean response. It is that of the probe to the
/// scene's light, sr^-1 m^-2. The mean is that of numbers which serve nothing else, so that the
/// target is the same whatever is drawn from it; 1 when none of the pilot's light reaches the
/// probe. Without lights there is nothing to draw and the floor is 0.
template <class Generator, class World, Executor E>
Generator generator_with_floor(const World& world, const typename Generator::Probe& probe,
                               std::uint32_t min_edges, std::uint32_t max_edges, TargetFloor floor,
                               std::uint64_t seed, E& executor) {
    Generator pilot(world, probe, min_edges, max_edges, 0.0);
    if (world.lights.empty()) return pilot;
    std::vector<double> image(floor.pilot_paths);
    std::vector<double> leaving(floor.pilot_paths);
    each_path(pilot, {seed, Stream::pilot, 0, floor.pilot_paths}, executor,
              [&](std::uint64_t i, const WeightedPath& p) {
                  if (!(p.density > 0.0)) return;
                  image[i] = p.weight;
                  leaving[i] = luminance(p.measure.leaving) / p.density;
              });
    const auto sum = [](const auto& v) { return std::accumulate(v.begin(), v.end(), 0.0); };
    const double seen = sum(image);
    const double mean = seen > 0.0 ? seen / sum(leaving) : 1.0;
    return {world, probe, min_edges, max_edges, static_cast<double>(floor.share) * mean};
}

}  // namespace mir
