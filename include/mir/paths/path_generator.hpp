// SPDX-License-Identifier: MIT
#pragma once

#include "mir/paths/grow.hpp"
#include "mir/paths/technique.hpp"

#include <utility>

namespace mir {

/// A path together with what it is worth. 4.6 kB. Where the weight is 0, nothing else is defined.
struct WeightedPath {
    Path path;             ///< x0 .. x_k and its light
    PathMeasure measure;   ///< contribution and densities of `path`
    double density = 0.0;  ///< of the generator at this path
    double weight = 0.0;   ///< Y(F) / density; 0: no light passes
};

/// Gives `out` its measure, density and weight, if light passes along its path. Visibility is not
/// asked for. `density` is a function of the PathMeasure.
template <class World, class Density>
MIR_HD bool weigh(const World& world, WeightedPath& out, const Density& density) {
    out.weight = 0.0;
    if (!measure_path(world, out.path, out.measure)) return false;
    out.density = density(out.measure);
    if (!(out.density > 0.0)) return false;
    const double weight = luminance(out.measure.contribution) / out.density;
    if (!is_finite(weight)) return false;
    out.weight = weight;
    return true;
}

/// Numbers that choose how x2 spreads light.
template <class Numbers>
MIR_HD Vec3 spread_at(Numbers& u) {
    const Vec2 uv = pair_at(u, path_dimension::spread);
    return {uv.x, uv.y, u.at(path_dimension::spread + 2)};
}

/// Builds full paths from numbers: a function from primary sample space to path space. Paths of all
/// techniques are weighed by the mixture density, so the mean of `weight` over uniform numbers is
/// P_c, the mean image luminance of paths with min_edges .. max_edges edges; visibility is
/// included. Const use from any thread.
template <class World>
class PathGenerator {
 public:
    /// Paths reach from the camera to a light.
    static constexpr bool has_camera = true;

    /// Keeps copies; what the world views must outlive it.
    PathGenerator(World world, const TechniqueTable& techniques)
        : world_(std::move(world)), techniques_(techniques) {}

    /// What paths run through.
    [[nodiscard]] MIR_HD const World& world() const { return world_; }
    /// Lengths and techniques that paths are drawn by.
    [[nodiscard]] MIR_HD const TechniqueTable& techniques() const { return techniques_; }

    /// The path at the point `u` of primary sample space; `u.at(d)` is coordinate d. Of what
    /// `out` was before nothing is read.
    // Inlined: for a function of its own, nvcc 13.0 reserves too little stack (memcheck tells).
    template <class Numbers>
    MIR_HD void generate(Numbers&& u, WeightedPath& out) const {
        out.weight = 0.0;
        const Technique t =
            techniques_.sample(static_cast<double>(u.at(path_dimension::technique)));
        const std::uint32_t from_eye = t.edges - t.from_light;
        if (!build(u, from_eye, t.from_light, out.path)) return;
        out.path.spread = spread_at(u);
        weigh(world_, out,
              [&](const PathMeasure& m) { return mixture_density(m, t.edges, techniques_); });
        if (out.weight > 0.0 && t.from_light > 0 && !edge_is_free(world_, out.path, from_eye))
            out.weight = 0.0;
    }

 private:
    template <class Numbers>
    MIR_HD bool build(Numbers& u, std::uint32_t from_eye, std::uint32_t from_light,
                      Path& path) const {
        if (!start_at_camera(world_, u, path)) return false;
        if (!extend_from_eye(world_, u, from_eye, path)) return false;
        return close_path(world_, u, from_light, path);
    }

    World world_;
    TechniqueTable techniques_;
};

}  // namespace mir
