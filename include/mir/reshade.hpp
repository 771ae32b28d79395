// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/visibility_matrix.hpp"
#include "mir/reconstruct.hpp"

namespace mir {

/// reconstruct() from visibility that is already known: no ray is traced. Intensities, materials,
/// bound, light groups and bounces may differ from when `matrix` was filled, since its bits say
/// nothing of them; places and number of VPLs and the luxels' hits may not. The image is that of
/// tracing, in every bit.
/// @throws Error(invalid_argument) when the matrix belongs to other tiles or VPLs.
template <class S, TiledGBuffer G, VplSet P, Shading F>
Image<Rgb> reshade(const S& scheduler, const G& gbuffer, P vpls, const VisibilityMatrix& matrix,
                   F shading) {
    expects(matrix.tiles() == gbuffer.tiles().size() && matrix.vpls() == vpls.size(),
            "a visibility matrix was used for luxels or VPLs that it was not made for (its bits do "
            "not fit); fill one for these");
    return reconstruct(scheduler, gbuffer, vpls, matrix.view(), shading);
}

}  // namespace mir
