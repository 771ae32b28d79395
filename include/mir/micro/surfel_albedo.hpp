// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/detail/triangle_pieces.hpp"
#include "mir/shading/mean_reflectance.hpp"
#include "mir/shading/surface_table.hpp"

namespace mir {

/// Reflectance of the Lambertian surfaces that discs stand for. It is mean_reflectance() of what
/// lies below the disc, with its textures and vertex colours. Of a BSDF that mean_reflectance()
/// does not know, the albedo at a typical angle. Scene data must outlive it; const use from any
/// thread.
template <Bsdf B>
class SurfelAlbedo {
    using Double3 = detail::Double3;

 public:
    /// Materials and triangles of one scene.
    SurfelAlbedo(const SurfaceTable<B>& surfaces, const WorldGeometry& geometry)
        : surfaces_(surfaces.view()), geometry_(geometry) {}

    /// 0..1, of a disc of make_surfels(). One without a triangle has that of its material
    /// alone. The mean over sixteen places where the material has textures, else that of the
    /// centre.
    [[nodiscard]] Rgb operator()(const Surfel& disc) const {
        if (disc.triangle == Surfel::no_triangle) return of(surfaces_.params(disc.material));
        if (disc.is_whole() || !surfaces_.entries[disc.material].textures.changes_reflection())
            return at(disc, Double3(0.0));
        Rgb sum;
        for (std::uint32_t i = 0; i < places; ++i) sum += at(disc, off_centre(disc, i));
        return sum * (1.0f / places);
    }

 private:
    static constexpr std::uint32_t places = 16;

    static Rgb of(const typename B::Params& p) {
        if constexpr (requires { mean_reflectance(p); })
            return mean_reflectance(p);
        else
            return B::albedo(p, {0.0f, 0.0f, 1.0f}, {0.6f, 0.0f, 0.8f});
    }
    [[nodiscard]] Rgb at(const Surfel& disc, Double3 off) const {
        const Vec2 place =
            detail::barycentrics_at(geometry_, disc.triangle, Double3(disc.position) + off);
        return of(
            surfaces_.params(disc.material, geometry_.view().attributes(disc.triangle, place)));
    }
    /// From the centre to that of one of the sixteen equal parts of the piece.
    static Double3 off_centre(const Surfel& disc, std::uint32_t part) {
        const detail::PiecePlace p = detail::piece_place(part, 2);
        const Double3 corner1(disc.corner1);
        const Double3 corner2(disc.corner2);
        const Double3 corner0 = -(corner1 + corner2);
        const auto share = [&](std::int64_t i) {
            return static_cast<double>(3 * i + p.sign) / 12.0;
        };
        return corner0 + share(p.i) * (corner1 - corner0) + share(p.j) * (corner2 - corner0);
    }

    SurfaceTableView<Space::host, B> surfaces_;
    const WorldGeometry& geometry_;
};

}  // namespace mir
