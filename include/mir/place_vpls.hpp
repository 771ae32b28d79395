// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/sampler.hpp"
#include "mir/fill_visibility.hpp"
#include "mir/normalise/normalise.hpp"

#include <optional>

namespace mir {

/// VPLs that are ready for reconstruct(), and what there is to say about them.
struct PlacedVpls {
    VplList vpls;                       ///< intensities in W sr^-1
    NormalisationReport normalisation;  ///< light that no luxel sees and that is lost
    std::optional<ChainHealth> health;  ///< of samplers that run Markov chains
};

/// Places VPLs and normalises them where their sampler leaves that to the image. It uses all
/// luxels of `gbuffer`: each recorded state then brings the same luminance to the image
/// (docs/method.md, 10). `shading` must be that of the image, its bound that of the sampler. The
/// shadow rays of the normalisation are traced here and their bits, one for each luxel and VPL,
/// thrown away; to shade from them call fill_visibility(), response(), normalise() and reshade()
/// instead.
/// @throws Error whatever the sampler reports; Error(limit_exceeded) when the bits do not fit into
///         Limits::visibility_bytes; Error(invalid_argument) when tiles cut blocks of 16 x 16.
template <Sampler S, TiledGBuffer G, Visibility V, Shading F, Executor E>
[[nodiscard]] PlacedVpls place_vpls(const S& sampler, const G& gbuffer, V visibility,
                                    const F& shading, E& executor, const Limits& limits = {}) {
    const VplRecords records = sampler.sample(executor);
    PlacedVpls placed{aggregate(records), {}, records.health};
    if constexpr (S::normalisation == Normalisation::image_response) {
        const auto vpls = placed.vpls.span();
        VisibilityMatrix bits(gbuffer.tiles(), vpls.size(), limits);
        fill_visibility(bits, gbuffer, vpls, visibility, executor);
        placed.normalisation =
            normalise(placed.vpls, response(gbuffer, vpls, bits, shading, executor),
                      records.path_luminance, records.states);
    }
    return placed;
}

}  // namespace mir
