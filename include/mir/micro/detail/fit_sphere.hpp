// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/detail/smallest_sphere.hpp"
#include "mir/micro/surfel_tree_options.hpp"

namespace mir::detail {

inline Double3 mean_centre(std::span<const Surfel> surfels) {
    Double3 sum(0.0);
    for (const Surfel& s : surfels) sum += Double3(s.position);
    return sum / static_cast<double>(surfels.size());
}

/// The two centres that lie farthest apart among those that are extreme on an axis.
inline std::pair<Double3, Double3> extreme_centres(std::span<const Surfel> surfels) {
    std::pair<Double3, Double3> best{surfels[0].position, surfels[0].position};
    for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax_element(surfels.begin(), surfels.end(),
                                                     [axis](const Surfel& a, const Surfel& b) {
                                                         return a.position[axis] < b.position[axis];
                                                     });
        const std::pair<Double3, Double3> found{low->position, high->position};
        if (glm::distance(found.first, found.second) > glm::distance(best.first, best.second))
            best = found;
    }
    return best;
}

/// Centre of Ritter's sphere. The ball over two distant centres, grown by each disc that it does
/// not hold just so far that it does. Source: Ritter, "An efficient bounding sphere", Graphics
/// Gems, 1990.
inline Double3 ritter_centre(std::span<const Surfel> surfels) {
    const auto [a, b] = extreme_centres(surfels);
    Ball ball{0.5 * (a + b), 0.5 * glm::distance(a, b)};
    for (const Surfel& s : surfels) {
        const double distance = farthest_distance(s, ball.centre);
        if (distance <= ball.radius) continue;
        const double step = 0.5 * (distance - ball.radius);
        ball.centre += step / distance * (farthest_point(s, ball.centre) - ball.centre);
        ball.radius += step;
    }
    return ball.centre;
}

/// Sphere around one or more discs. In exact arithmetic it contains every point of each of them:
/// the radius is rounded upwards, past the error of the distances it is made of.
struct FittedSphere {
    Vec3 centre{0};
    float radius = 0.0f;
};

inline FittedSphere fit_sphere(std::span<const Surfel> surfels, SphereFit fit) {
    if (surfels.size() == 1) return {surfels[0].position, surfels[0].radius};
    const Vec3 centre(fit == SphereFit::mean     ? mean_centre(surfels)
                      : fit == SphereFit::ritter ? ritter_centre(surfels)
                                                 : smallest_sphere_centre(surfels));
    const double radius = farthest_disc(surfels, Double3(centre)).distance;
    return {centre, rounded_up(radius * (1.0 + 0x1p-47))};
}

}  // namespace mir::detail
