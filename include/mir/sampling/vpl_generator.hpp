// SPDX-License-Identifier: MIT
#pragma once

#include "mir/paths/path_generator.hpp"
#include "mir/sampling/probe_sight.hpp"

#include <utility>

namespace mir {

/// Density of light paths x2 .. x_k, drawn by `t` or another technique.
struct VplDensity {
    /// `from_probe`: density of x2 as the end of a ray from the probe.
    static double mixture(const PathMeasure& m, Technique t, const TechniqueTable& table,
                          double from_probe) {
        const std::uint32_t k = t.edges;
        double light_path = m.emission;
        for (std::uint32_t i = 2; i < k; ++i) light_path *= m.from_light[i];
        return from_probe * suffix_density(m, k, table) +
               table.probability(k) * table.probability_of({k, k - 1}) * light_path;
    }
};

/// Builds light paths z = (x2, ..., x_k) from numbers, without a camera. x2 is the place of a
/// VPL. It is the end of a light path, or what a ray from a luxel of a probe meets; the rest
/// of the path follows from both ends as in PathGenerator. The target of the paths is P~(z) =
/// Y(t R) + floor Y(R), where R is the radiance that leaves x2 and t what the probe responds
/// to it: what z gives to the probe's luxels, and to luxels that the probe does not know of
/// at least something. The weight of a path is P~ over the density of all techniques
/// together. The `contribution` of its measure is t R; x1 and what lies before it are not
/// set.
///
/// Sources: Segovia, Iehl, Mitanchey, Peroche, "Bidirectional instant radiosity", EGSR 2006, for
/// VPLs from either side; Veach 1997, section 9.2, for the density. World and probe must outlive
/// it; const use from any thread.
template <class World, class Density = VplDensity>
class VplGenerator {
 public:
    /// What judges paths; asks the kind of visibility that the world asks.
    using Probe = ImageProbe<typename World::Bsdf, decltype(World::visibility)>;
    static constexpr bool has_camera = false;  ///< paths begin at x2

    /// Paths of min_edges (2: also VPLs on lamps) to max_edges edges. `floor`, sr^-1 m^-2, must be
    /// positive wherever a target of 0 would lose light.
    VplGenerator(World world, const Probe& probe, std::uint32_t min_edges, std::uint32_t max_edges,
                 double floor)
        : world_(std::move(world)),
          probe_(probe),
          // Light paths alone reach every place that sends out light.
          techniques_(min_edges, max_edges, PathTechniques::bidirectional),
          floor_(floor) {}

    /// What paths run through.
    [[nodiscard]] const World& world() const { return world_; }
    /// Lengths and techniques, both sides' (PathTechniques::bidirectional).
    [[nodiscard]] const TechniqueTable& techniques() const { return techniques_; }
    /// Weight of R in the target, sr^-1 m^-2.
    [[nodiscard]] double floor() const { return floor_; }
    /// P~ of a path that generate() has measured.
    [[nodiscard]] double target(const PathMeasure& m) const {
        return luminance(m.contribution) + floor_ * luminance(m.leaving);
    }

    /// The path at the point `u` of primary sample space; `u.at(d)` is coordinate d. `out` is
    /// written whole; density and weight are 0 when no light leaves x2.
    template <class Numbers>
    void generate(Numbers&& u, WeightedPath& out) const {
        out.weight = out.density = 0.0;
        const Technique t =
            techniques_.sample(static_cast<double>(u.at(path_dimension::technique)));
        ProbeRay start;
        if (!build(u, t, out.path, start)) return;
        out.path.spread = spread_at(u);
        if (measure_suffix(world_, out.path, out.measure) && is_connected(out.path, t))
            weigh(t, start, out);
    }

 private:
    template <class Numbers>
    bool build(Numbers& u, Technique t, Path& path, ProbeRay& start) const {
        path.vertices.resize(1);
        if (t.from_light + 1 < t.edges)
            return start_at_probe(u, path, start) &&
                   extend_from_eye(world_, u, t.edges - t.from_light, path) &&
                   close_path(world_, u, t.from_light, path);
        return attach_light_path(world_, u, t.from_light, path);
    }

    template <class Numbers>
    bool start_at_probe(Numbers& u, Path& path, ProbeRay& start) const {
        const std::uint32_t d = path_dimension::eye_vertex(1);
        const auto ray =
            ray_from_probe(probe_, u.at(path_dimension::film), pair_at(u, d), u.at(d + 2));
        if (!ray) return false;
        start = *ray;
        PathVertex second;
        if (!world_.hit(start.ray, second, start.passed)) return false;
        path.vertices.push_back(second);
        return true;
    }

    [[nodiscard]] bool is_connected(const Path& path, Technique t) const {
        const bool whole = t.from_light == 0 || t.from_light + 1 == t.edges;
        return whole || edge_is_free(world_, path, t.edges - t.from_light);
    }

    /// Through panes a luxel sees x2 or not by a bit, and sight_of() counts those that do. A ray
    /// from a luxel passed by numbers of its own: it counts where the bit says the same, over its
    /// chance. So the weights of all techniques add up to one, whatever the bits are (Veach's
    /// multi-sample model, each luxel a technique).
    void weigh(Technique t, const ProbeRay& start, WeightedPath& out) const {
        const PathVertex& x = out.path.x(2);
        const bool has_passed = start.passed < 1.0f;
        const ProbeSight sight = sight_of(probe_, Vpl{x.position, x.normal, {}},
                                          has_passed ? start.luxel : ProbeRay::none);
        if (has_passed && !sight.is_seen) return;
        out.measure.response = sight.response;
        out.measure.contribution = out.measure.response * out.measure.leaving;
        const double density =
            Density::mixture(out.measure, t, techniques_, sight.density * stop_chance(out.path)) *
            static_cast<double>(start.passed);
        const double weight = target(out.measure) / density;
        if (!(density > 0.0) || !std::isfinite(weight)) return;
        out.density = density;
        out.weight = weight;
    }

    /// Chance with which a ray that meets x2 ends there, if that is a lamp. Other vertices lie
    /// where light paths end, with the same chance. The direction matters for glass alone, which no
    /// ray ends on.
    [[nodiscard]] double stop_chance(const Path& path) const {
        if (path.edges() > 2) return 1.0;
        return static_cast<double>(world_.stop_chance(path.x(2), path.x(2).normal));
    }

    World world_;
    const Probe& probe_;
    TechniqueTable techniques_;
    double floor_;
};

}  // namespace mir
