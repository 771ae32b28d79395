// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/detail/disc_reach.hpp"

#include <optional>
#include <vector>

namespace mir::detail {

/// A sphere in double precision, metres.
struct Ball {
    Double3 centre{0};
    double radius = 0.0;
};

/// Smallest sphere with all of 1 to 4 points on it. None where they lie so that there is none.
inline std::optional<Ball> ball_through(std::span<const Double3> points) {
    const std::size_t n = points.size() - 1;
    // Centre p0 + sum of x_i v_i, v_i = p_i - p0, with v_i . (2 sum of x_j v_j - v_i) = 0.
    double m[3][4] = {};
    for (std::size_t i = 0; i < n; ++i) {
        const Double3 v = points[i + 1] - points[0];
        for (std::size_t j = 0; j < n; ++j) m[i][j] = 2.0 * glm::dot(v, points[j + 1] - points[0]);
        m[i][n] = glm::dot(v, v);
    }
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k; i < n; ++i)
            if (std::fabs(m[i][k]) > std::fabs(m[pivot][k])) pivot = i;
        if (!(std::fabs(m[pivot][k]) > 1e-9 * m[0][n])) return std::nullopt;
        std::swap(m[k], m[pivot]);
        for (std::size_t i = 0; i < n; ++i) {
            if (i == k) continue;
            const double factor = m[i][k] / m[k][k];
            for (std::size_t j = k; j <= n; ++j) m[i][j] -= factor * m[k][j];
        }
    }
    Double3 offset(0.0);
    for (std::size_t i = 0; i < n; ++i) offset += m[i][n] / m[i][i] * (points[i + 1] - points[0]);
    return Ball{points[0] + offset, glm::length(offset)};
}

/// Smallest ball around a few points. Those that it is known to touch, 1 to 4 of them.
class BallBasis {
 public:
    explicit BallBasis(Double3 first) : points_{first}, ball_{first, 0.0} {}

    [[nodiscard]] const Ball& ball() const { return ball_; }

    /// Makes it the smallest ball around its points and one more, which lies outside. False where
    /// rounding leaves none.
    bool add(Double3 p) {
        std::vector<Double3> best;
        Ball found{{}, std::numeric_limits<double>::infinity()};
        for (std::uint32_t subset = 0; subset < (1u << points_.size()); ++subset) {
            std::vector<Double3> chosen{p};
            for (std::size_t i = 0; i < points_.size(); ++i)
                if ((subset >> i & 1u) != 0) chosen.push_back(points_[i]);
            if (chosen.size() > 4) continue;
            const auto ball = ball_through(chosen);
            if (!ball || ball->radius >= found.radius || !contains_points(*ball)) continue;
            found = *ball;
            best = chosen;
        }
        if (best.empty()) return false;
        points_ = best;
        ball_ = found;
        return true;
    }

 private:
    [[nodiscard]] bool contains_points(const Ball& ball) const {
        return std::all_of(points_.begin(), points_.end(), [&](Double3 q) {
            return glm::distance(q, ball.centre) <= ball.radius * (1.0 + 1e-9);
        });
    }

    std::vector<Double3> points_;
    Ball ball_;
};

/// Centre of a sphere around discs, a thousandth larger than the smallest at most. The farthest
/// point of any disc is added until none lies outside. Every ball on the way is the smallest around
/// points of the discs, thus not larger than the sphere that is looked for. Sources: Welzl,
/// "Smallest enclosing disks (balls and ellipsoids)", LNCS 555, 1991, with the pivots of Gaertner,
/// "Fast and robust smallest enclosing balls", ESA 1999.
inline Double3 smallest_sphere_centre(std::span<const Surfel> surfels) {
    const Double3 start(surfels[0].position);
    BallBasis basis(farthest_point(surfels[farthest_disc(surfels, start).index], start));
    Ball best{start, std::numeric_limits<double>::infinity()};
    constexpr int most_rounds = 64;
    for (int round = 0; round < most_rounds; ++round) {
        const Double3 centre = basis.ball().centre;
        const FarthestDisc farthest = farthest_disc(surfels, centre);
        if (farthest.distance < best.radius) best = {centre, farthest.distance};
        if (farthest.distance <= basis.ball().radius * 1.001) break;
        if (!basis.add(farthest_point(surfels[farthest.index], centre))) break;
    }
    return best.centre;
}

}  // namespace mir::detail
