// SPDX-License-Identifier: MIT
#pragma once

// What VPLs do to the image, from the visibility that a BackendFrame stored.

#include "mir/resident/uploaded_vpls.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "runtime/backend_frame.hpp"

namespace mir {

template <Backend M, Bsdf B>
std::vector<ImageResponse> BackendFrame<M, B>::row_responses(const FrameBand& band, Vpls vpls,
                                                             float bound) {
    const Band& here = of(band);
    UploadedVpls<M> there(machine_, vpls);
    BackendResponse<M> sums(machine_, band.extent(), vpls.size());
    const WaitAtEnd wait(queue_);
    there.send(queue_);
    return sums.rows(queue_, here.gbuffer, there.view(), *here.visibility, VplShading<B>{bound});
}

}  // namespace mir
