// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/exact/cluster_record.hpp"

namespace mir {

/// The hull of a VPL and a cluster's box. It holds all segments between the VPL and the cluster's
/// luxels, cut by the half-space in front of the cluster. A point of it at the share t of the way
/// from the VPL lies in the box apex + t [low - apex, high - apex]. Rates are shares of the way per
/// metre; their signs come from where the VPL lies beside the box, never from a difference that may
/// be a signed zero. Finite for finite clusters.
struct alignas(16) Shaft {
    AffineRow front{0, 0, 0, 1};  ///< negative behind the cluster
    Vec3 apex{0};                 ///< the VPL, metres
    Vec3 rises{0};   ///< not negative: t is at least rises (plane - apex) above a lower face
    Vec3 falls{0};   ///< not positive: t is at least falls (plane - apex) below an upper face
    Vec3 leaves{0};  ///< t is at most leaves (plane - apex); 0 where the VPL lies beside no face
};

/// What rounding may add to a share t when planes are single precision numbers. Differences,
/// reciprocals and products round to 5 units of 2^-24 of t in all; the rest is for underflow.
struct FloatPlaneSlack {
    static constexpr float relative = 1.00001f;  ///< factor of t
    static constexpr float absolute = 1e-7f;     ///< added to that
};

namespace detail {

/// Rates of one axis.
struct ShaftRates {
    float rises = 0.0f;
    float falls = 0.0f;
    float leaves = 0.0f;
};

/// `low` and `high` are the box's faces seen from the VPL, metres. A face at the VPL itself or next
/// to it counts as straddled: segments in that face never leave it.
MIR_HD inline ShaftRates shaft_rates(float low, float high) {
    constexpr float least = 1e-18f;
    const bool plus = low > least;
    const bool minus = high < -least;
    ShaftRates rates;
    if (!minus) rates.rises = strict::div(1.0f, larger(high, least));
    if (!plus) rates.falls = -strict::div(1.0f, larger(-low, least));
    if (plus) rates.leaves = strict::div(1.0f, low);
    if (minus) rates.leaves = -strict::div(1.0f, -high);
    return rates;
}

/// The cluster's half-space with 2 sigma to spare for rounding. It is the whole space when the VPL
/// lies behind it.
MIR_HD inline AffineRow front_of(const ClusterRecord& cluster, Vec3 apex, float sigma) {
    AffineRow front = cluster.front;
    if (!(row_at(front, apex) >= 0.0f)) return {0, 0, 0, 1};
    front.w = strict::add(front.w, 2.0f * sigma);
    return front;
}

/// Bounds of t along one axis.
struct ShaftInterval {
    float near = 0.0f;
    float far = 1.0f;
};

/// Part of `t` in which the shaft meets the slab between two planes. They are given relative to the
/// VPL.
MIR_HD inline ShaftInterval meet_slab(ShaftInterval t, ShaftRates rates, float low, float high) {
    t.near = larger(t.near, strict::mul(low, rates.rises));
    t.near = larger(t.near, strict::mul(high, rates.falls));
    const float face = rates.leaves > 0.0f ? high : low;
    if (rates.leaves != 0.0f) t.far = smaller(t.far, strict::mul(face, rates.leaves));
    return t;
}

MIR_HD inline bool in_front(AffineRow front, Vec3 low, Vec3 high) {
    const Vec3 foremost(front.x > 0.0f ? high.x : low.x, front.y > 0.0f ? high.y : low.y,
                        front.z > 0.0f ? high.z : low.z);
    return row_at(front, foremost) >= 0.0f;
}

}  // namespace detail

/// Shaft of a cluster that has luxels and a VPL at `apex`, metres. `sigma` as for the cluster.
[[nodiscard]] MIR_HD inline Shaft make_shaft(const ClusterRecord& cluster, Vec3 apex, float sigma) {
    const Vec3 low = cluster.low - apex;
    const Vec3 high = cluster.high - apex;
    const detail::ShaftRates x = detail::shaft_rates(low.x, high.x);
    const detail::ShaftRates y = detail::shaft_rates(low.y, high.y);
    const detail::ShaftRates z = detail::shaft_rates(low.z, high.z);
    return {detail::front_of(cluster, apex, sigma),
            apex,
            {x.rises, y.rises, z.rises},
            {x.falls, y.falls, z.falls},
            {x.leaves, y.leaves, z.leaves}};
}

/// False only if the shaft misses the closed box from `low` to `high`. No segment between the VPL
/// and a point of the cluster's box within its half-space has a point in it (finite, metres). For
/// given t the shaft's section is a box, so it meets the other if and only if six inequalities
/// linear in t have a common solution; what is left out or rounded is on the side of true.
template <class Slack = FloatPlaneSlack>
[[nodiscard]] MIR_HD inline bool meets_box(const Shaft& s, Vec3 low, Vec3 high) {
    const Vec3 a = low - s.apex;
    const Vec3 b = high - s.apex;
    detail::ShaftInterval t;
    t = detail::meet_slab(t, {s.rises.x, s.falls.x, s.leaves.x}, a.x, b.x);
    t = detail::meet_slab(t, {s.rises.y, s.falls.y, s.leaves.y}, a.y, b.y);
    t = detail::meet_slab(t, {s.rises.z, s.falls.z, s.leaves.z}, a.z, b.z);
    const float end = strict::add(strict::mul(Slack::relative, t.far), Slack::absolute);
    return t.near <= end && detail::in_front(s.front, low, high);
}

}  // namespace mir
