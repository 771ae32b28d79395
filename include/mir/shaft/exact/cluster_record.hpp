// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/reach.hpp"
#include "mir/accel/exact/triangle_rows.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"

#include <cmath>

namespace mir {

/// Luxels of a cluster: a word of visibility. A block is eight of them.
inline constexpr std::uint32_t cluster_luxels = 32;
inline constexpr std::uint32_t block_luxels = 256;  ///< of a block

/// A box with one leaning axis. Points are measured along it from a plane that is tilted against
/// the other two. On a sloping surface it is as thin as the surface is flat.
struct TiltedAxis {
    static constexpr std::uint32_t none = 3;  ///< no axis leans

    std::uint32_t axis = none;  ///< 0 to 2, or `none`
    Vec3 slope{0};              ///< of the plane along the other axes; 0 along its own
    float low = 0.0f;           ///< of along() at the luxels, metres, with 2 sigma to spare
    float high = 0.0f;          ///< of the same

    /// The point's distance from the plane along the axis, metres.
    [[nodiscard]] MIR_HD float along(Vec3 p) const {
        const float own = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
        const float xy = strict::add(strict::mul(slope.x, p.x), strict::mul(slope.y, p.y));
        return strict::sub(own, strict::add(xy, strict::mul(slope.z, p.z)));
    }
};

/// What shafts know about a cluster, a compact run of luxels. A box, a tilted one and a
/// half-space hold all of its nonempty luxels. Aligned so that the device fetches it in whole
/// words.
struct alignas(16) ClusterRecord {
    AffineRow front{0, 0, 0, 1};  ///< at least 2 sigma at every luxel, up to rounding; metres
    Vec3 low{0};                  ///< of the luxels' box grown by sigma, metres
    Vec3 high{0};                 ///< of the same box
    std::uint32_t luxels = 0;     ///< that are not empty; the box says nothing when there are none
    TiltedAxis tilt;              ///< of the box where it leans
};

/// True when the proofs of docs/shaft_proofs.md hold for the cluster's luxels. Segments to others
/// may be cut (reach.hpp), and are then none of the shaft's. False when a coordinate is not a
/// number.
[[nodiscard]] MIR_HD inline bool within_reach(const ClusterRecord& cluster, float reach) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(fabsf(cluster.low[axis]) <= reach) || !(fabsf(cluster.high[axis]) <= reach))
            return false;
    return true;
}

namespace detail {

/// Box, sum of normals and number of the nonempty luxels of a run.
struct ClusterSum {
    Vec3 low{0};
    Vec3 high{0};
    Vec3 normals{0};
    std::uint32_t luxels = 0;

    MIR_HD void add(const Hit& hit) {
        const Vec3 p = hit.position;
        low = luxels == 0 ? p : glm::min(low, p);
        high = luxels == 0 ? p : glm::max(high, p);
        normals += hit.normal;
        ++luxels;
    }
    /// Adds what others come to, if there are any.
    MIR_HD void add(const ClusterSum& others) {
        if (others.luxels == 0) return;
        low = luxels == 0 ? others.low : glm::min(low, others.low);
        high = luxels == 0 ? others.high : glm::max(high, others.high);
        normals += others.normals;
        luxels += others.luxels;
    }
};

MIR_HD inline ClusterSum sum_of_cluster(const SoaView<const Hit>& hits, std::uint32_t first,
                                        std::uint32_t count) {
    ClusterSum sum;
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Hit hit = hits.load(i);
        if (!is_empty(hit)) sum.add(hit);
    }
    return sum;
}

/// The direction of `v` as gradient of a row through the origin. It is zero when `v` is next to
/// nothing: normals that cancel leave a rest without a meaning.
MIR_HD inline AffineRow direction_row(Vec3 v) {
    const float length = sqrtf(row_at({v.x, v.y, v.z, 0.0f}, v));
    if (!(length > 1e-4f)) return {};
    return {strict::div(v.x, length), strict::div(v.y, length), strict::div(v.z, length), 0.0f};
}

/// Smallest value of a row at the luxels of a run that are not empty. 0 if all are. Luxels that are
/// no number count only where they come first: the row then is none either.
MIR_HD inline float least_at(AffineRow row, const SoaView<const Hit>& hits, std::uint32_t first,
                             std::uint32_t count) {
    bool found = false;
    float least = 0.0f;
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Hit hit = hits.load(i);
        if (is_empty(hit)) continue;
        const float value = row_at(row, hit.position);
        least = found ? smaller(value, least) : value;
        found = true;
    }
    return least;
}

/// Record of one or more luxels whose box does not lean. `front` is a row through the origin,
/// `least` or more at all of them; it is moved to where records want it.
MIR_HD inline ClusterRecord upright_record(const ClusterSum& sum, AffineRow front, float least,
                                           float sigma) {
    ClusterRecord cluster;
    cluster.low = sum.low - sigma;
    cluster.high = sum.high + sigma;
    cluster.luxels = sum.luxels;
    cluster.front = front;
    cluster.front.w = strict::sub(2.0f * sigma, least);
    return cluster;
}

/// The axis nearest to `n` leans, so that a plane of that normal is level.
MIR_HD inline TiltedAxis tilted_axis(AffineRow n) {
    const Vec3 size(fabsf(n.x), fabsf(n.y), fabsf(n.z));
    TiltedAxis tilt;
    if (!(larger(size.x, larger(size.y, size.z)) > 0.5f)) return tilt;
    tilt.axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const float own = tilt.axis == 0 ? n.x : tilt.axis == 1 ? n.y : n.z;
    tilt.slope = {tilt.axis == 0 ? 0.0f : -strict::div(n.x, own),
                  tilt.axis == 1 ? 0.0f : -strict::div(n.y, own),
                  tilt.axis == 2 ? 0.0f : -strict::div(n.z, own)};
    return tilt;
}

/// Gives a record with a box the axis that leans, if that helps. The box must become thinner. `low`
/// and `high` bound tilt.along() at its luxels. docs/shaft_proofs.md says what the other conditions
/// are for.
MIR_HD inline void set_tilt(ClusterRecord& cluster, TiltedAxis tilt, float low, float high,
                            float sigma) {
    if (tilt.axis == TiltedAxis::none) return;
    const Vec3 size = cluster.high - cluster.low;
    const Vec3 centre = 0.5f * (cluster.low + cluster.high);
    tilt.low = strict::sub(low, 2.0f * sigma);
    tilt.high = strict::add(high, 2.0f * sigma);
    const std::uint32_t k = tilt.axis;
    const float own_size = k == 0 ? size.x : k == 1 ? size.y : size.z;
    const float off = strict::sub(0.5f * strict::add(tilt.low, tilt.high), tilt.along(centre));
    const bool is_thinner = strict::sub(tilt.high, tilt.low) < own_size;
    const bool is_small = larger(size.x, larger(size.y, size.z)) <= 0x1p16f * sigma;
    if (is_thinner && is_small && fabsf(off) <= 0.5f * own_size) cluster.tilt = tilt;
}

/// Least and largest number of some, in that order.
struct Range {
    float low = 0.0f;
    float high = 0.0f;
};

MIR_HD inline Range range_along(const TiltedAxis& tilt, const SoaView<const Hit>& hits,
                                std::uint32_t first, std::uint32_t count) {
    Range range{INFINITY, -INFINITY};
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Hit hit = hits.load(i);
        if (is_empty(hit)) continue;
        const float value = tilt.along(hit.position);
        range = {smaller(value, range.low), larger(value, range.high)};
    }
    return range;
}

}  // namespace detail

/// Record of the luxels first .. first + count - 1. Its box leans where that makes it thinner.
/// `sigma` is sigma_of() the scene's magnitude, metres.
[[nodiscard]] MIR_HD inline ClusterRecord cluster_record(const SoaView<const Hit>& hits,
                                                         std::uint32_t first, std::uint32_t count,
                                                         float sigma) {
    const detail::ClusterSum sum = detail::sum_of_cluster(hits, first, count);
    if (sum.luxels == 0) return {};
    const AffineRow front = detail::direction_row(sum.normals);
    ClusterRecord cluster =
        detail::upright_record(sum, front, detail::least_at(front, hits, first, count), sigma);
    const TiltedAxis tilt = detail::tilted_axis(cluster.front);
    const detail::Range range = detail::range_along(tilt, hits, first, count);
    detail::set_tilt(cluster, tilt, range.low, range.high, sigma);
    return cluster;
}

/// One run of luxels, one record: kernel over all clusters of one size. Luxels beyond the last one
/// are padding, that is empty, and are there to be read.
struct ClusterRecords {
    SoaView<const Hit> hits;           ///< in cluster order
    std::uint32_t run = 32;            ///< luxels of a cluster
    float sigma = 0.0f;                ///< of the scene, metres
    ClusterRecord* records = nullptr;  ///< one for each cluster

    /// Cluster `i`: luxels i run to i run + run - 1.
    MIR_HD void operator()(std::uint32_t i) const {
        records[i] = cluster_record(hits, i * run, run, sigma);
    }
};

}  // namespace mir
