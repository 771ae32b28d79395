// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/cpu/detail/embree.hpp"
#include "mir/scene/opacity.hpp"

namespace mir::cpu::detail {

/// Rays of a query as their callers gave them, for filters. Embree knows them by origin and
/// direction alone, whose sum is not the other end to the last bit.
struct Segments {
    Vec3 from{0};              ///< shared end, metres
    const float* x = nullptr;  ///< of the other ends, by RTCRay::id
    const float* y = nullptr;
    const float* z = nullptr;

    /// What hides the ends of ray number `id` from each other.
    [[nodiscard]] SegmentOpacity<Space::host> opacity(const OpacityView<Space::host>& surfaces,
                                                      unsigned id) const {
        return surfaces.between(from, {x[id], y[id], z[id]});
    }
};

/// Calls is_solid(k, triangle, barycentrics) for the hits of a packet or a single ray, and rejects
/// those where it says no. Embree goes on behind them.
template <class IsSolid>
void reject_hits(const RTCFilterFunctionNArguments* args, const IsSolid& is_solid) {
    for (unsigned k = 0; k < args->N; ++k) {
        if (args->valid[k] == 0) continue;
        const Vec2 barycentrics{RTCHitN_u(args->hit, args->N, k), RTCHitN_v(args->hit, args->N, k)};
        if (!is_solid(k, RTCHitN_primID(args->hit, args->N, k), barycentrics)) args->valid[k] = 0;
    }
}

inline const OpacityView<Space::host>& opacity_of(const RTCFilterFunctionNArguments* args) {
    return *static_cast<const OpacityView<Space::host>*>(args->geometryUserPtr);
}

/// Filter of closest hits: rejects those in holes.
inline void reject_holes(const RTCFilterFunctionNArguments* args) {
    const AlphaMaskView<Space::host> masks = opacity_of(args).masks();
    reject_hits(args, [&](unsigned, std::uint32_t triangle, Vec2 barycentrics) {
        return masks.is_solid(triangle, barycentrics);
    });
}

/// Filter of segments: rejects hits that do not stop them; of queries without Segments, holes.
inline void reject_open(const RTCFilterFunctionNArguments* args) {
    // Every context that this filter is asked with is a Query.
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-static-cast-downcast)
    const Segments* segments = static_cast<const Query*>(args->context)->segments;
    if (segments == nullptr) return reject_holes(args);
    const OpacityView<Space::host>& surfaces = opacity_of(args);
    reject_hits(args, [&](unsigned k, std::uint32_t triangle, Vec2 barycentrics) {
        return segments->opacity(surfaces, RTCRayN_id(args->ray, args->N, k))
            .is_solid(triangle, barycentrics);
    });
}

/// Makes Embree ask `opacity`, which must outlive the geometry, about each hit of it.
inline void filter_by(RTCGeometry geometry, OpacityView<Space::host>& opacity) {
    rtcSetGeometryUserData(geometry, &opacity);
    if (opacity.masks().exists()) rtcSetGeometryIntersectFilterFunction(geometry, &reject_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, &reject_open);
}

/// @throws Error(device) when Embree cannot ask.
inline void require_filters(RTCDevice device) {
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_FILTER_FUNCTION_SUPPORTED) != 0) return;
    throw Error(ErrorCode::device,
                "this Embree was built without filter functions (it cannot let through what alpha "
                "masks and glass do); use another one or a kd-tree (--accel kdtree)");
}

}  // namespace mir::cpu::detail
