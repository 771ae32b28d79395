// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/cpu/detail/embree.hpp"
#include "mir/scene/alpha_mask.hpp"

namespace mir::cpu::detail {

/// Rejects hits, of a packet or a single ray, where the triangle is not there. Embree goes on
/// behind them. The same for closest hits and for occlusion.
inline void reject_holes(const RTCFilterFunctionNArguments* args) {
    const auto& mask = *static_cast<const AlphaMaskView<Space::host>*>(args->geometryUserPtr);
    for (unsigned k = 0; k < args->N; ++k) {
        if (args->valid[k] == 0) continue;
        const Vec2 barycentrics{RTCHitN_u(args->hit, args->N, k), RTCHitN_v(args->hit, args->N, k)};
        if (!mask.is_solid(RTCHitN_primID(args->hit, args->N, k), barycentrics)) args->valid[k] = 0;
    }
}

/// Makes Embree ask `mask`, which must outlive the geometry, about each hit of it.
inline void filter_by(RTCGeometry geometry, AlphaMaskView<Space::host>& mask) {
    rtcSetGeometryUserData(geometry, &mask);
    rtcSetGeometryIntersectFilterFunction(geometry, &reject_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, &reject_holes);
}

/// @throws Error(device) when Embree cannot ask.
inline void require_filters(RTCDevice device) {
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_FILTER_FUNCTION_SUPPORTED) != 0) return;
    throw Error(ErrorCode::device,
                "this Embree was built without filter functions (it cannot leave out what alpha "
                "masks cut away); use another one or a kd-tree (--accel kdtree)");
}

}  // namespace mir::cpu::detail
