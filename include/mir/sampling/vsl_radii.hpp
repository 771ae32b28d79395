// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/core/point_tree.hpp"
#include "mir/data/vpl.hpp"
#include "mir/sampling/visible_area.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace mir {

/// VPLs whose distance tells how dense they are around another.
inline constexpr std::uint32_t vsl_neighbours = 10;

/// Radius of the sphere around each VPL, metres. That of the disc which is its share of the surface
/// among its nearest neighbours, d_k / sqrt(k) with d_k the distance to the k-th (vsl_neighbours),
/// times `scale`. Where there are no k others, the radius r0 at which as many discs cover
/// `visible_area` (docs/method.md, 4.3), and never below a tenth of that, because samplers may put
/// many VPLs on one point. 0, points, where the area is 0 too. Deterministic.
template <Executor E>
std::vector<float> vsl_radii(std::span<const Vpl> vpls, double visible_area, float scale,
                             E& executor) {
    const auto n = static_cast<std::uint32_t>(vpls.size());
    const double covering =
        visible_area > 0.0 ? std::sqrt(visible_area * static_cast<double>(inv_pi) / n) : 0.0;
    std::vector<float> radii(n, scale * static_cast<float>(covering));
    if (n <= vsl_neighbours) return radii;
    std::vector<Vec3> places(n);
    std::transform(vpls.begin(), vpls.end(), places.begin(),
                   [](const Vpl& v) { return v.position; });
    const PointTree tree(places);
    const auto least = static_cast<float>(0.1 * covering);
    const float share = 1.0f / static_cast<float>(vsl_neighbours);
    executor.for_each(n, [&](std::size_t j) {
        const float squared = tree.kth_distance_squared(places[j], vsl_neighbours + 1);  // itself
        radii[j] = scale * std::max(std::sqrt(squared * share), least);
    });
    return radii;
}

/// Share of the first radius that the spheres of pass `pass` have. Passes count from 0:
/// r_{i+1}^2 = r_i^2 (i + 2/3) / (i + 1), i from 1. The mean of all passes then loses
/// the blur of the spheres while its noise falls too. Source: Knaus and Zwicker,
/// "Progressive photon mapping: a probabilistic approach", ACM TOG 30(3), 2011, equation
/// 15.
inline double vsl_radius_share(std::uint32_t pass) {
    double squared = 1.0;
    for (std::uint32_t i = 1; i <= pass; ++i) squared *= (i + 2.0 / 3.0) / (i + 1.0);
    return std::sqrt(squared);
}

}  // namespace mir
