// SPDX-License-Identifier: MIT
#pragma once

// Who sees which VPL, and what that does to the image: stored visibility of BackendFrame.

#include "mir/resident/uploaded_vpls.hpp"
#include "runtime/backend_frame/structures.hpp"

namespace mir {

template <Backend M, Bsdf B>
void BackendFrame<M, B>::find_visible(FrameBand& band, Vpls vpls) {
    auto& luxels = dynamic_cast<Band&>(band);
    UploadedVpls<M> there(machine_, vpls);
    const WaitAtEnd wait(queue_);
    there.send(queue_);
    luxels.visibility.emplace(machine_, luxels.gbuffer.grid(), vpls.size(), job_.settings.limits);
    with_tile_visibility([&](const auto& visibility) {
        luxels.visibility->find(queue_, luxels.gbuffer, there.view(), visibility);
    });
    queue_.record().sync();
}

}  // namespace mir
