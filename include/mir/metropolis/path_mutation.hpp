// SPDX-License-Identifier: MIT
#pragma once

#include "mir/paths/path_generator.hpp"

#include <cmath>

namespace mir {

/// A range of a path that is taken out: x_0 .. x_left and x_right .. x_k stay. left = 0 takes the
/// camera's end with it, right = k + 1 the light's.
struct PathGap {
    std::uint32_t left = 0;   ///< last vertex that stays on the camera's side
    std::uint32_t right = 0;  ///< first that stays on the light's side

    /// Vertices taken out.
    [[nodiscard]] MIR_HD std::uint32_t vertices() const { return right - left - 1; }
};

/// The choices of Veach's bidirectional mutation and their probabilities. A value; const use from
/// any thread. Source: Veach 1997, section 11.4.2.
class GapChoices {
 public:
    /// For paths of min_edges to max_edges edges, which every choice keeps to.
    MIR_HD GapChoices(std::uint32_t min_edges, std::uint32_t max_edges)
        : min_(min_edges), max_(max_edges) {}

    /// Range to take out of a path of k edges. One number in [0, 1) picks it.
    [[nodiscard]] MIR_HD PathGap sample_gap(std::uint32_t k, double u) const {
        PathGap last{0, k + 1};
        double rest = u * total_weight(k);
        for_each_gap(k, [&](PathGap g, double weight) {
            if (rest >= 0.0) last = g;
            rest -= weight;
        });
        return last;
    }
    /// Probability of that choice.
    [[nodiscard]] MIR_HD double gap_probability(std::uint32_t k, PathGap gap) const {
        return weight_of(k, gap) / total_weight(k);
    }

    /// Number of vertices to put into the gap.
    [[nodiscard]] MIR_HD std::uint32_t sample_count(std::uint32_t k, PathGap gap, double u) const {
        double rest = u * total_count_weight(k, gap);
        std::uint32_t last = gap.vertices();
        for (std::uint32_t n = 0; n <= max_; ++n) {
            const double weight = count_weight(k, gap, n);
            if (weight > 0.0 && rest >= 0.0) last = n;
            rest -= weight;
        }
        return last;
    }
    /// Probability that sample_count() puts `n` vertices into this gap. 0 where no path comes of
    /// it.
    [[nodiscard]] MIR_HD double count_probability(std::uint32_t k, PathGap gap,
                                                  std::uint32_t n) const {
        return count_weight(k, gap, n) / total_count_weight(k, gap);
    }

    /// Fewest of `n` new vertices that must come from the camera's side: x1 always does.
    MIR_HD static std::uint32_t min_from_eye(PathGap gap) { return gap.left == 0 ? 1 : 0; }

 private:
    /// 2^-|a - b|, exact.
    MIR_HD static double halved(std::uint32_t a, std::uint32_t b) {
        return ldexp(1.0, a > b ? static_cast<int>(b) - static_cast<int>(a)
                                : static_cast<int>(a) - static_cast<int>(b));
    }
    template <class Body>
    MIR_HD void for_each_gap(std::uint32_t k, Body&& body) const {
        for (std::uint32_t left = 0; left <= k; ++left)
            for (std::uint32_t right = left + 1; right <= k + 1; ++right)
                if (const double w = weight_of(k, {left, right}); w > 0.0)
                    body(PathGap{left, right}, w);
    }
    /// Small gaps are likelier. The one that moves x1 alone is rare, because it yields no new VPL.
    /// An edge can be cut open only where a vertex fits in.
    [[nodiscard]] MIR_HD double weight_of(std::uint32_t k, PathGap gap) const {
        const bool at_end = gap.left == 0 || gap.right == k + 1;
        if (gap.left > k || (gap.vertices() == 0 && (at_end || k == max_))) return 0.0;
        const double weight = halved(gap.vertices(), 1);
        return gap.left == 0 && gap.vertices() == 1 ? 0.25 * weight : weight;
    }
    [[nodiscard]] MIR_HD double total_weight(std::uint32_t k) const {
        double sum = 0.0;
        for_each_gap(k, [&](PathGap, double w) { sum += w; });
        return sum;
    }
    /// Two-tailed geometric around the old count.
    [[nodiscard]] MIR_HD double count_weight(std::uint32_t k, PathGap gap, std::uint32_t n) const {
        const std::uint32_t edges = k - gap.vertices() + n;
        if (edges < min_ || edges > max_) return 0.0;
        const bool at_end = gap.left == 0 || gap.right == k + 1;
        if (n == 0 && (at_end || gap.vertices() == 0)) return 0.0;
        return halved(n, gap.vertices());
    }
    [[nodiscard]] MIR_HD double total_count_weight(std::uint32_t k, PathGap gap) const {
        double sum = 0.0;
        for (std::uint32_t n = 0; n <= max_; ++n) sum += count_weight(k, gap, n);
        return sum;
    }

    std::uint32_t min_;
    std::uint32_t max_;
};

/// Density of the `n` vertices between the ends of a gap. The path has k edges; all splits of them
/// into a camera's and a light's side count. Leaving out splits that could have built the same
/// vertices would break detailed balance. x2 counts in PathMeasure::area_unit too: what is x2 of
/// the one path may be x3 of the other.
MIR_HD inline double refill_density(const PathMeasure& m, std::uint32_t k, std::uint32_t left,
                                    std::uint32_t n) {
    const std::uint32_t fewest = GapChoices::min_from_eye({left, left + n + 1});
    double sum = 0.0;
    for (std::uint32_t eye = fewest; eye <= n; ++eye) {
        const std::uint32_t from_light = n - eye;
        double density = 1.0;
        for (std::uint32_t i = left + 1; i <= left + eye; ++i)
            density *= i == 1 ? 1.0 : m.from_eye[i];
        for (std::uint32_t i = left + eye + 1; i <= left + n; ++i)
            density *= i < k ? m.from_light[i] : from_light == 1 ? m.next_event : m.emission;
        sum += density;
    }
    const bool holds_second = left < 2 && left + n >= 2;
    return sum * (holds_second ? m.area_unit : 1.0) / static_cast<double>(n - fewest + 1);
}

/// Replaces the gap of `x` by `n` new vertices and connects. `from_eye` of them grow from the
/// camera's side, the others from the light's. False when that leads nowhere; the light that passes
/// is not computed.
template <class World, class Numbers>
MIR_HD bool refill(const World& world, Numbers& u, const Path& x, PathGap gap, std::uint32_t n,
                   std::uint32_t from_eye, Path& y) {
    y.film = x.film;
    y.lens = x.lens;
    y.eye = x.eye;
    y.chain = x.chain;
    y.vertices.assign_front(x.vertices, gap.left);
    if (gap.left == 0 && !start_at_camera(world, u, y)) return false;
    if (!extend_from_eye(world, u, gap.left + from_eye, y)) return false;
    const std::uint32_t from_light = n - from_eye;
    const std::uint32_t k = x.edges();
    if (gap.right == k + 1) {
        if (!close_path(world, u, from_light, y)) return false;
        if (from_light == 0) return true;
    } else {
        const std::uint32_t kept = k - gap.right + 1;
        y.vertices.resize(y.edges() + from_light + kept);
        y.light = x.light;
        LightPart part{y};
        while (part.size < kept) part.add(x.x(k - part.size));
        if (!extend_from_light(world, u, kept + from_light, part)) return false;
    }
    return edge_is_free(world, y, gap.left + from_eye);
}

}  // namespace mir
