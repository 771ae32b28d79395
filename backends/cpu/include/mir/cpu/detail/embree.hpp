// SPDX-License-Identifier: MIT
#pragma once

// The only file that includes Embree, and the only one that knows its major versions apart.
// MIR_EMBREE_MAJOR picks one where both are installed.
#if !defined(MIR_EMBREE_MAJOR)
#if __has_include(<embree4/rtcore.h>)
#define MIR_EMBREE_MAJOR 4
#else
#define MIR_EMBREE_MAJOR 3
#endif
#endif

#if MIR_EMBREE_MAJOR == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace mir::cpu::detail {

/// Embree 4 lets a geometry mask start at 1, Embree 3 at all bits. Both ends are always set.
inline constexpr unsigned all_rays = 0xFFFFFFFFu;

#if MIR_EMBREE_MAJOR == 4

inline void intersect1(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &ray); }

inline void occluded1(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray); }

/// Sixteen rays from one origin.
inline void occluded16(const int* valid, RTCScene scene, RTCRay16& rays) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcOccluded16(valid, scene, &rays, &arguments);
}

#else

inline RTCIntersectContext context(RTCIntersectContextFlags flags) {
    RTCIntersectContext c;
    rtcInitIntersectContext(&c);
    c.flags = flags;
    return c;
}

inline void intersect1(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectContext c = context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcIntersect1(scene, &c, &ray);
}

inline void occluded1(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext c = context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcOccluded1(scene, &c, &ray);
}

/// Sixteen rays from one origin.
inline void occluded16(const int* valid, RTCScene scene, RTCRay16& rays) {
    RTCIntersectContext c = context(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    rtcOccluded16(valid, scene, &c, &rays);
}

#endif

}  // namespace mir::cpu::detail
