// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/data/visibility_matrix.hpp"
#include "mir/data/vpl_list.hpp"

namespace mir {

/// An engine that runs the loops over luxels and VPLs itself, so that a render need not know with
/// what visibility: fill_visibility(matrix, gbuffer, vpls, executor) and reconstruct(scheduler,
/// gbuffer, vpls, shading) are the functions of those names with its own. Detected and used where
/// present.
template <class N, class B, class E>
concept LoopEngine = requires(const N n, VisibilityMatrix& matrix,
                              const BlockedGBuffer<typename B::Params>& gbuffer,
                              VplSpan<Space::host> vpls, E& executor) {
    n.fill_visibility(matrix, gbuffer, vpls, executor);
};

}  // namespace mir
