// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/paths/path_measure.hpp"
#include "mir/paths/path_techniques.hpp"

#include <cmath>

namespace mir {

/// One way to build a path of k edges. s vertices come from the light (0: the camera's part runs
/// into a lamp, 1: light sample, more: light path), k - s from the camera, x1 always among them.
struct Technique {
    std::uint32_t edges = 2;       ///< k, at least 2
    std::uint32_t from_light = 1;  ///< s, 0 to k - 1
};

/// Which techniques are used how often. First the length, geometrically distributed and cut to
/// [min_edges, max_edges], then s among what `techniques` allows. Immutable value; made on the
/// host, used anywhere.
///
/// A path that runs into a lamp is drawn a quarter as often as one that ends otherwise: other
/// techniques build the same path, and most lamps are small. One with two vertices from the light
/// is drawn twice as often: where lamps shine at a wall it carries most of the light. What that is
/// worth: docs/decisions/046.
class TechniqueTable {
 public:
    /// @throws Error(invalid_argument) when the range is empty or too long.
    TechniqueTable(std::uint32_t min_edges, std::uint32_t max_edges, PathTechniques techniques)
        : min_(min_edges), max_(max_edges), techniques_(techniques) {
        expects(min_edges >= 2 && min_edges <= max_edges && max_edges <= max_path_edges,
                "path lengths must run from 2 (direct light) or 3 up to at most 64 edges; raise "
                "or lower the largest bounce");
        const double ratio = length_ratio(max_edges - min_edges);
        double total = 0.0;
        for (std::uint32_t k = min_; k <= max_; ++k) total += pmf_[k] = std::pow(ratio, k - min_);
        for (std::uint32_t k = min_; k <= max_; ++k) pmf_[k] /= total;
    }

    /// The same for what lies behind a given x2. As many vertices from the camera at least.
    [[nodiscard]] TechniqueTable behind_second_vertex() const {
        TechniqueTable t = *this;
        t.from_eye_ = 2;
        return t;
    }

    /// Edges of the shortest path, at least 2.
    [[nodiscard]] MIR_HD std::uint32_t min_edges() const { return min_; }
    /// Edges of the longest path, at most max_path_edges.
    [[nodiscard]] MIR_HD std::uint32_t max_edges() const { return max_; }

    /// Technique for one number in [0, 1).
    [[nodiscard]] MIR_HD Technique sample(double u) const {
        Technique t{min_, 1};
        while (t.edges < max_ && u >= pmf_[t.edges]) u -= pmf_[t.edges++];
        if (techniques_ == PathTechniques::camera) return t;
        const std::uint32_t choices = choices_of(t.edges);
        double rest = (u > 0.0 ? u / pmf_[t.edges] : 0.0) * weights_below(choices);
        t.from_light = 0;
        while (t.from_light + 1 < choices && rest >= weight(t.from_light))
            rest -= weight(t.from_light++);
        return t;
    }

    /// Probability of a length.
    [[nodiscard]] MIR_HD double probability(std::uint32_t edges) const {
        return edges >= min_ && edges <= max_ ? pmf_[edges] : 0.0;
    }
    /// Probability of s, given the length.
    [[nodiscard]] MIR_HD double probability_of(Technique t) const {
        const std::uint32_t choices = choices_of(t.edges);
        if (t.from_light >= choices) return 0.0;
        if (techniques_ == PathTechniques::bidirectional)
            return weight(t.from_light) / weights_below(choices);
        return t.from_light == 1 ? 1.0 : 0.0;
    }

 private:
    /// How much rarer each further edge is. Even the longest path must be likelier than the 2^-24
    /// that numbers resolve, or it would never be drawn.
    static double length_ratio(std::uint32_t further_edges) {
        return further_edges == 0 ? 0.72 : std::max(0.72, std::exp2(-20.0 / further_edges));
    }

    /// How many s there are.
    [[nodiscard]] MIR_HD std::uint32_t choices_of(std::uint32_t edges) const {
        return edges + 1 - from_eye_;
    }
    /// How often s is used next to others.
    MIR_HD static double weight(std::uint32_t s) { return s == 0 ? 0.25 : s == 2 ? 2.0 : 1.0; }
    /// Sum of weight() over all s below `end` > 0.
    MIR_HD static double weights_below(std::uint32_t end) { return end + (end > 2 ? 0.25 : -0.75); }

    std::uint32_t min_;
    std::uint32_t max_;
    std::uint32_t from_eye_ = 1;  ///< vertices at least that grow from the camera
    PathTechniques techniques_;
    double pmf_[max_path_edges + 1] = {};
};

/// Density of x_(first) .. x_k when the vertices before are given and the last `s` come from the
/// light, for s <= k - first + 1.
MIR_HD inline double technique_density(const PathMeasure& m, std::uint32_t k, std::uint32_t s,
                                       std::uint32_t first = 2) {
    double density = s == 0 ? 1.0 : s == 1 ? m.next_event : m.emission;
    for (std::uint32_t i = first; i <= k - s; ++i) density *= m.from_eye[i];
    for (std::uint32_t i = k - s + 1; i < k; ++i) density *= m.from_light[i];
    return density;
}

/// Density with which the table's techniques together build the path. What the balance heuristic
/// divides by (Veach 1997, section 9.2).
MIR_HD_CALL inline double mixture_density(const PathMeasure& m, std::uint32_t k,
                                          const TechniqueTable& table) {
    double density = 0.0;
    for (std::uint32_t s = 0; s < k; ++s) {
        const double probability = table.probability_of({k, s});
        if (probability > 0.0) density += probability * technique_density(m, k, s);
    }
    return density * table.probability(k);
}

/// The same for x3 .. x_k alone, x2 being given: the techniques that reach x2 from the camera.
MIR_HD_CALL inline double suffix_density(const PathMeasure& m, std::uint32_t k,
                                         const TechniqueTable& table) {
    double density = 0.0;
    for (std::uint32_t s = 0; s + 2 <= k; ++s) {
        const double probability = table.probability_of({k, s});
        if (probability > 0.0) density += probability * technique_density(m, k, s, 3);
    }
    return density * table.probability(k);
}

}  // namespace mir
