// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/known_visibility.hpp"
#include "mir/concepts/scheduler.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/shading/check_bound.hpp"

namespace mir {

/// What a scheduler works on. `visibility` is a way to trace segments, or bits that were traced
/// before.
template <TiledGBuffer G, VplSet P, VisibilitySource V, Shading F>
struct Inputs {
    const G& gbuffer;  ///< must outlive the pipeline
    P vpls;            ///< that light every luxel
    V visibility;      ///< where it was found before: of these luxels and these VPLs
    F shading;         ///< reads the surfaces that `gbuffer` holds
};

/// Algorithm 3 of the paper: the radiance of the VPLs through each luxel. In W m^-2 sr^-1, one
/// element per luxel of the G-buffer in row order. Emission is not included.
///
/// The scheduler decides where and when things run, never what comes out.
/// @throws Error(invalid_argument) when the shading has a bound that is none (check_bound()), and
///         whatever the backend reports.
template <class S, TiledGBuffer G, VplSet P, VisibilitySource V, Shading F>
Image<Rgb> reconstruct(const S& scheduler, const G& gbuffer, P vpls, V visibility, F shading) {
    using In = Inputs<G, P, V, F>;
    using Luxels = decltype(gbuffer.view(TileIndex{}));
    static_assert(std::same_as<typename Luxels::Surface, typename F::Surface>,
                  "mir: the shading reads other surface data than the G-buffer holds; use one Bsdf "
                  "for both");
    static_assert(Scheduler<S, In>,
                  "mir: the first argument of reconstruct() is not a Scheduler for these inputs");
    check_shading(shading);
    const In in{gbuffer, vpls, visibility, shading};
    Image<Rgb> luxels(gbuffer.extent());
    auto pipeline = scheduler.open(in, luxels);
    for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t) pipeline.submit(t);
    pipeline.finish();
    return luxels;
}

}  // namespace mir
