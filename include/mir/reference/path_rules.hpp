// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

#include <concepts>

namespace mir {

/// The formulas by which a path tracer weighs what it finds. A policy, so that another heuristic or
/// another roulette is one function; the estimate is unbiased when
///  1. mis(a, b) + mis(b, a) = 1, and mis(a, 0) = 1;
///  2. roulette(t, u) has mean t over u uniform in [0, 1), and is black with odds that have a lower
///     bound, or a path between white walls never ends;
///  3. per_steradian() converts densities exactly.
template <class P>
concept PathRules = requires(float x, Rgb throughput) {
    { P::mis(x, x) } -> std::same_as<float>;
    { P::per_steradian(x, x, x) } -> std::same_as<float>;
    { P::roulette(throughput, x) } -> std::same_as<Rgb>;
};

/// The balance heuristic and roulette by throughput. Model of PathRules.
struct BalanceRules {
    /// Weight of a point found with density `own` > 0, `other` being another technique's. Densities
    /// are of one measure and count samples (n p). Source: Veach and Guibas, "Optimally combining
    /// sampling techniques for Monte Carlo rendering", SIGGRAPH 1995.
    MIR_HD static float mis(float own, float other) { return 1.0f / (1.0f + other / own); }

    /// Density per steradian of a surface point with density `per_area` (m^-2). It is seen from
    /// squared distance `d2` (m^2); its normal makes `cosine` with the line of sight.
    MIR_HD static float per_steradian(float per_area, float d2, float cosine) {
        return per_area * d2 / cosine;
    }

    /// Largest odds of survival. Where nothing is absorbed a path ends after a thousand vertices on
    /// average. Not lower, because a path that goes on weighs 1 / odds more each time: the variance
    /// stays finite up to a reflectance of sqrt(odds).
    static constexpr float most_odds = 0.999f;

    /// Throughput of a path after Russian roulette with the number `u`, black when it ends. The
    /// odds of survival are the largest channel of `throughput`, at most `most_odds`. Source: Arvo
    /// and Kirk, "Particle transport and image synthesis", SIGGRAPH 1990.
    MIR_HD static Rgb roulette(Rgb throughput, float u) {
        const float odds = smaller(max_channel(throughput), most_odds);
        return u < odds ? throughput * (1.0f / odds) : Rgb{};
    }
};

/// BalanceRules with the power heuristic of exponent 2. Model of PathRules.
struct PowerRules : BalanceRules {
    /// Weight own^2 / (own^2 + other^2), for own > 0.
    MIR_HD static float mis(float own, float other) {
        const float ratio = other / own;
        return 1.0f / (1.0f + ratio * ratio);
    }
};

static_assert(PathRules<BalanceRules> && PathRules<PowerRules>);

}  // namespace mir
