// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/inline_vector.hpp"
#include "mir/core/math.hpp"
#include "mir/data/light_point.hpp"

#include <cstdint>

namespace mir {

/// Longest path that the path-space samplers can hold, in edges.
inline constexpr std::uint32_t max_path_edges = 64;

/// A vertex of a path on a surface, or the light end of the path.
struct PathVertex {
    Vec3 position{0};            ///< lifted off the surface, metres
    Vec3 normal{0};              ///< unit geometric normal of the side that the path runs on
    Vec3 shading_normal{0};      ///< unit, same side
    Vec2 barycentrics{0};        ///< weights of the triangle's second and third vertex
    std::uint32_t triangle = 0;  ///< index into WorldGeometry
    std::uint32_t material = 0;  ///< index into Scene::materials
    bool on_coat = false;        ///< reflects by the rough coat of the material alone
    /// Light goes through diffusely. Place and normals are those of the camera's side then, and of
    /// x1, whose camera seems to stand opposite, those of the light's.
    bool is_through = false;
};

/// What is known about the light at the end of a path besides its place.
struct LightEnd {
    LightOrigin origin = LightOrigin::surface;  ///< of the light
    std::uint16_t light_group = 0;              ///< of the light
    std::uint32_t light = 0;                    ///< as LightTable::sample_light() counts
    Rgb emission;                               ///< LightPoint::emission
    double pdf_next_event = 0.0;  ///< of choosing this end for a given receiver: probability of the
                                  ///< light times LightPoint::pdf
    double pdf_emission = 0.0;    ///< of starting a light path here, same units
};

/// A full light transport path x0 (lens), x1, ..., x_k (light). Place and direction of the first
/// edge are given by film and lens, so x1 is a function of them. 3.5 kB, without memory elsewhere.
struct Path {
    Vec2 film{0};  ///< in [0,1]^2, origin top left
    Vec2 lens{0};  ///< in [0,1)^2
    /// x0, metres, or the last point of the specular chain through which x1 is seen.
    Vec3 eye{0};
    Rgb chain{1.0f, 1.0f, 1.0f};  ///< what that chain leaves of what x1 reflects
    Vec3 spread{0};               ///< numbers that choose how x_2 spreads light, [0,1)^3
    InlineVector<PathVertex, max_path_edges> vertices;  ///< x1 .. x_k; element i - 1 is x_i
    LightEnd light;  ///< what shines at the end; its place is x_k

    /// k: the number of edges.
    [[nodiscard]] MIR_HD std::uint32_t edges() const { return vertices.size(); }
    /// Scattering events, k - 1: the bounce that the path counts in.
    [[nodiscard]] MIR_HD std::uint32_t bounce() const { return edges() - 1; }
    /// x_i, 1 <= i <= edges().
    [[nodiscard]] MIR_HD const PathVertex& x(std::uint32_t i) const { return vertices[i - 1]; }
    /// x_i, 1 <= i <= edges(), to write to.
    [[nodiscard]] MIR_HD PathVertex& x(std::uint32_t i) { return vertices[i - 1]; }
    /// True when light arrives at x_i on the side that its normals point away from.
    [[nodiscard]] MIR_HD bool is_lit_behind(std::uint32_t i) const {
        return i > 1 && x(i).is_through;
    }
    /// Position of x_i, x0 included.
    [[nodiscard]] MIR_HD Vec3 position(std::uint32_t i) const {
        return i == 0 ? eye : vertices[i - 1].position;
    }
};

}  // namespace mir
