// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_record.hpp"
#include "mir/shading/glossy_shading.hpp"
#include "mir/shading/surface_table.hpp"
#include "mir/shading/widened.hpp"
#include "mir/sum_seen.hpp"

namespace mir {

/// Lobes of the VPLs that aggregate() makes of records with arrivals, by their index. Lobes
/// narrower than the GGX width `least_alpha` are widened to it, because a few points instead of a
/// surface show a narrow one as spots.
template <Bsdf B>
struct VplLobes {
    std::vector<VplLobe<B>> lobes;  ///< by VPL
    float widened_share = 0.0f;     ///< of the VPLs' intensity (luminance), 0..1

    /// Of records that met these surfaces.
    /// @throws Error(invalid_argument) when the records have no arrivals.
    VplLobes(const VplRecords& from, const SurfaceTable<B>& surfaces, float least_alpha) {
        expects(
            from.arrivals.size() == from.records.size(),
            "VPLs were to keep the lobes of their surfaces but nobody knows from where they are "
            "lit; ask the sampler for arrivals");
        const auto view = surfaces.view();
        double all = 0.0;
        double narrow = 0.0;
        for (std::size_t i = 0; i < from.records.size(); ++i) {
            const double j = luminance(from.records[i].vpl.intensity);
            all += j;
            VplLobe<B>& lobe = lobes.emplace_back();
            if (from.records[i].lobe_share == 0.0f) continue;
            const VplArrival& a = from.arrivals[i];
            const typename B::Params own =
                view.params_of_side(view.params(a.material, a.attributes), a.material, a.is_front);
            lobe = {true, a.shading_normal, a.towards_light, a.power, widened(own, least_alpha)};
            if (is_widened(own, least_alpha)) narrow += j;
        }
        if (all > 0.0) widened_share = static_cast<float>(narrow / all);
    }
};

/// Light of VPLs with these lobes. Radiance towards the viewer of every luxel, W m^-2 sr^-1.
/// `matrix` says who sees which VPL; black VPLs are left out. Bits as of sum_seen().
/// @throws Error(invalid_argument) when the matrix belongs to other tiles or VPLs, or the lobes do.
template <Bsdf B, TiledGBuffer G, Executor E>
Image<Rgb> glossy_light(const G& gbuffer, const VisibilityMatrix& matrix, VplSpan<Space::host> vpls,
                        std::span<const VplLobe<B>> lobes, GlossyShading<B> shading, E& executor) {
    expects(lobes.size() == vpls.size(),
            "VPLs were given lobes of others (each needs one); give as many as there are VPLs");
    const auto reflects = [&](const auto& surface) { return shading.reflects(surface); };
    return sum_seen(
        gbuffer, matrix, vpls.size(), reflects,
        [&](const Hit& hit, const auto& surface, VplIndex j) {
            if (is_black(vpls[j].intensity)) return Rgb{};
            return shading(hit, surface, vpls[j], lobes[j]);
        },
        executor);
}

}  // namespace mir
