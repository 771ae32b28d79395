// SPDX-License-Identifier: MIT
#pragma once

// What VPLs do to the image, from the visibility that a BackendFrame stored.

#include "mir/normalise/response.hpp"
#include "mir/resident/backend_response.hpp"
#include "mir/resident/uploaded_vpls.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "runtime/backend_frame.hpp"

namespace mir {

template <Backend M, Bsdf B>
void BackendFrame<M, B>::add_responses(const FrameBand& band, Vpls vpls, float bound,
                                       BandTurn& turn, ResponseSum& sum) {
    const Band& here = of(band);
    UploadedVpls<M> there(machine_, vpls);
    BackendResponse<M> responses(machine_, band.extent(), vpls.size());
    const WaitAtEnd wait(queue_);
    there.send(queue_);
    responses.sum_rows(queue_, here.gbuffer, there.view(), *here.visibility, VplShading<B>{bound});
    turn.wait();
    sum.add_by(band.extent(),
               [&](std::span<ImageResponse> totals) { responses.add_rows(queue_, totals); });
}

}  // namespace mir
