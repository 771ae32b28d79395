// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/number_text.hpp"
#include "mir/scene/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace mir::detail {

/// Steps between neighbouring floats that the median edge of a mesh should have. Rounding of its
/// corners then turns and shortens it by a thousandth.
inline constexpr double least_steps = 1000.0;

/// Distance of the floats next to a coordinate; same unit.
inline double float_step(double coordinate) {
    const auto x = static_cast<float>(std::fabs(coordinate));
    return static_cast<double>(std::nextafter(x, std::numeric_limits<float>::infinity())) -
           static_cast<double>(x);
}

/// Median length of the edges of at most 1024 triangles, in the mesh's unit. They are spread over
/// the mesh; edges without length do not count. 0 when there are none, or a triangle names no
/// vertex.
inline double median_edge(const Mesh& mesh) {
    constexpr std::size_t most = 1024;
    const std::size_t count = mesh.triangles.size();
    const std::size_t taken = std::min(count, most);
    std::vector<double> lengths;
    for (std::size_t i = 0; i < taken; ++i) {
        const TriangleIndices& t = mesh.triangles[i * count / taken];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = t[k];
            const std::size_t b = t[(k + 1) % 3];
            if (std::max(a, b) >= mesh.positions.size()) return 0.0;
            const double length = glm::length(DVec3(mesh.positions[b]) - DVec3(mesh.positions[a]));
            if (length > 0.0) lengths.push_back(length);
        }
    }
    if (lengths.empty()) return 0.0;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
}

/// "0.00781 m".
inline std::string metres(double length) { return number_text(length, 3) + " m"; }

/// Collects meshes with edges that are short beside the steps of floats. The floats hold their
/// corners; one sentence is about all of them.
class CoarseMeshes {
 public:
    /// `reach`: largest coordinate of a corner; `edge`: median_edge(). Both in one unit; `unit` of
    /// it are a metre of the world.
    void look_at(const std::string& name, double reach, double edge, double unit) {
        const double steps = edge / float_step(reach);
        if (!(steps > 0.0 && steps < least_steps)) return;
        ++count_;
        if (steps >= steps_) return;
        steps_ = steps;
        name_ = name;
        reach_ = reach / unit;
        edge_ = edge / unit;
    }

    /// Appends "`problem` (how many): ... (`remedy`)"; nothing when no mesh is coarse.
    void append_to(std::vector<std::string>& remarks, const std::string& problem,
                   const std::string& remedy) const {
        if (count_ == 0) return;
        remarks.push_back(problem + " (" + std::to_string(count_) + "): " + in_quotes(name_) +
                          " reaches " + metres(reach_) + ", where 32-bit numbers lie " +
                          metres(edge_ / steps_) + " apart, 1/" + number_text(steps_, 3) +
                          " of its median edge of " + metres(edge_) + " (" + remedy + ")");
    }

 private:
    std::size_t count_ = 0;
    double steps_ = std::numeric_limits<double>::infinity();
    std::string name_;
    double reach_ = 0.0;
    double edge_ = 0.0;
};

}  // namespace mir::detail
