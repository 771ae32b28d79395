// SPDX-License-Identifier: MIT
#pragma once

// Which structure BackendFrame traces by: for the other headers of this folder.

#include "mir/resident/ray_structures.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "runtime/backend_frame.hpp"

#include <type_traits>

namespace mir {

template <Backend M, Bsdf B>
template <class Use>
auto BackendFrame<M, B>::with_rays(const Use& use) const {
    if (!job_.geometry.is_opaque())
        return use(WideRays<space, OpacityView<space>>{bvh_->view(), opacity_there()});
    if (tree_) return use(KdRays<space>{tree_->view()});
    return use(WideRays<space>{bvh_->view()});
}

template <Backend M, Bsdf B>
template <class Use>
auto BackendFrame<M, B>::with_tile_visibility(const Use& use) const {
    if (short_open_bvh_) {
        using Sight = WideBvhVisibility<space, Opaque>;
        using Veil = WideBvhVisibility<space, OpacityView<space>>;
        return use(VeiledClusterVisibility<Sight, Veil>{short_bvh_->view(),
                                                        sigma_,
                                                        {opaque_bvh_->view(), {}},
                                                        short_open_bvh_->view(),
                                                        {open_bvh_->view(), opacity_there()}});
    }
    return with_rays([&](const auto& rays) {
        const auto sight = rays.sight();
        using Sight = std::remove_const_t<decltype(sight)>;
        if constexpr (std::is_same_v<Sight, WideBvhVisibility<space, OpacityView<space>>>) {
            return use(sight);
        } else {
            if (!short_bvh_) return use(sight);
            return use(ClusterVisibility<Sight>{short_bvh_->view(), sigma_, sight});
        }
    });
}

}  // namespace mir
