// SPDX-License-Identifier: MIT
#pragma once

#include "mir/paths/path_generator.hpp"

#include <utility>

namespace mir {

/// Redraws x3 .. x_k of a path while x0, x1 and x2 stay, at least one reflection behind x2: an
/// independence chain on the light behind one VPL, with the target Y(F) + floor Y(R). Its states
/// bring the same geometric VPL, so they cost nothing at reconstruction (docs/method.md, 11.6).
/// Const use from any thread.
template <class World>
class SuffixProposal {
 public:
    /// `floor`: that of VplGenerator, in the unit of PathMeasure::response.
    SuffixProposal(World world, const TechniqueTable& techniques, double floor = 0.0)
        : world_(std::move(world)), techniques_(techniques.behind_second_vertex()), floor_(floor) {}

    /// Density of x3 .. x_k under draw(), up to a factor that all paths share.
    [[nodiscard]] MIR_HD double density(const PathMeasure& m, std::uint32_t k) const {
        return suffix_density(m, k, techniques_);
    }

    /// The target over that density: the weight of the independence chain.
    [[nodiscard]] MIR_HD double weight(const PathMeasure& m, std::uint32_t k) const {
        const double target = luminance(m.contribution) + floor_ * luminance(m.leaving);
        const double p = density(m, k);
        return p > 0.0 && is_finite(target / p) ? target / p : 0.0;
    }

    /// A path with the x0, x1, x2 of `from` and a new rest. Its weight is that of weight(), 0 when
    /// nothing came of it.
    template <class Numbers>
    MIR_HD void draw(const WeightedPath& from, Numbers&& u, WeightedPath& out) const {
        out.weight = 0.0;
        const Technique t =
            techniques_.sample(static_cast<double>(u.at(path_dimension::technique)));
        if (t.edges < 3) return;
        const std::uint32_t from_eye = t.edges - t.from_light;
        Path& y = out.path;
        y.film = from.path.film;
        y.lens = from.path.lens;
        y.eye = from.path.eye;
        y.chain = from.path.chain;
        y.vertices.assign_front(from.path.vertices, 2);
        y.spread = spread_at(u);
        if (!extend_from_eye(world_, u, from_eye, y) || !close_path(world_, u, t.from_light, y))
            return;
        if (!measure_suffix(world_, y, out.measure)) return;
        out.measure.response = from.measure.response;
        out.measure.contribution = out.measure.response * out.measure.leaving;
        if (t.from_light == 0 || edge_is_free(world_, y, from_eye))
            out.weight = weight(out.measure, t.edges);
    }

 private:
    World world_;
    TechniqueTable techniques_;
    double floor_;
};

}  // namespace mir
