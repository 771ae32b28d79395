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

struct Segments;

#if MIR_EMBREE_MAJOR == 4

/// What Embree hands to filters.
struct Query : RTCRayQueryContext {
    const Segments* segments;  ///< of the rays; may be null

    explicit Query(const Segments* of) : segments(of) { rtcInitRayQueryContext(this); }
};

inline void intersect1(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &ray); }

inline RTCOccludedArguments arguments(Query& query, RTCRayQueryFlags flags) {
    RTCOccludedArguments a;
    rtcInitOccludedArguments(&a);
    a.flags = flags;
    a.context = &query;
    return a;
}

inline void occluded1(RTCScene scene, RTCRay& ray, const Segments* segments) {
    Query query(segments);
    RTCOccludedArguments a = arguments(query, RTC_RAY_QUERY_FLAG_INCOHERENT);
    rtcOccluded1(scene, &ray, &a);
}

/// Sixteen rays from one origin.
inline void occluded16(const int* valid, RTCScene scene, RTCRay16& rays, const Segments* segments) {
    Query query(segments);
    RTCOccludedArguments a = arguments(query, RTC_RAY_QUERY_FLAG_COHERENT);
    rtcOccluded16(valid, scene, &rays, &a);
}

#else

/// What Embree hands to filters.
struct Query : RTCIntersectContext {
    const Segments* segments;  ///< of the rays; may be null

    Query(RTCIntersectContextFlags with, const Segments* of) : segments(of) {
        rtcInitIntersectContext(this);
        flags = with;
    }
};

inline void intersect1(RTCScene scene, RTCRayHit& ray) {
    Query query(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT, nullptr);
    rtcIntersect1(scene, &query, &ray);
}

inline void occluded1(RTCScene scene, RTCRay& ray, const Segments* segments) {
    Query query(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT, segments);
    rtcOccluded1(scene, &query, &ray);
}

/// Sixteen rays from one origin.
inline void occluded16(const int* valid, RTCScene scene, RTCRay16& rays, const Segments* segments) {
    Query query(RTC_INTERSECT_CONTEXT_FLAG_COHERENT, segments);
    rtcOccluded16(valid, scene, &query, &rays);
}

#endif

}  // namespace mir::cpu::detail
