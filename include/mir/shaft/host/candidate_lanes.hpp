// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/packet_hits.hpp"
#include "mir/accel/exact/triangle_lanes.hpp"
#include "mir/shaft/exact/occlusion.hpp"

#include <limits>

namespace mir::detail {

/// The box of a cluster as triangles are tested against it. It keeps within centre -+ half, metres.
struct ClusterBox {
    Vec3 centre{0};
    Vec3 half{0};
};

inline ClusterBox cluster_box(const ClusterRecord& cluster) {
    const Vec3 centre = 0.5f * (cluster.low + cluster.high);
    return {centre, glm::max(cluster.high - centre, centre - cluster.low)};
}

/// What triangles, a bit each, do to the segments of a pair.
struct LaneOcclusion {
    std::uint32_t none = 0;  ///< hit none of them
    std::uint32_t full = 0;  ///< hit all of them
};

/// a f + b g, the offset included.
inline AffineRow combine_rows(float a, AffineRow f, float b, AffineRow g) {
    const auto mix = [a, b](float x, float y) {
        return strict::add(strict::mul(a, x), strict::mul(b, y));
    };
    return {mix(f.x, g.x), mix(f.y, g.y), mix(f.z, g.z), mix(f.w, g.w)};
}

/// The first minus the two others.
inline AffineRow subtract_rows(AffineRow f, AffineRow g, AffineRow h) {
    const auto rest = [](float x, float y, float z) { return strict::sub(strict::sub(x, y), z); };
    return {rest(f.x, g.x, h.x), rest(f.y, g.y, h.y), rest(f.z, g.z, h.z), rest(f.w, g.w, h.w)};
}

/// Sixteen triangles, made ready for one VPL. The affine functions s', U, V and W of occlusion.hpp,
/// once for all clusters that are asked about. Left uninitialised, because there are many for each
/// pair and most are not used.
struct CandidateLanes {
    LaneRows beyond;  ///< s': distance beyond the plane as seen from the VPL, metres
    LaneRows u;       ///< U, V, W: not negative where the segment crosses inside
    LaneRows v;
    LaneRows w;
    LaneFloats margin;    ///< of U, V and W; infinite where nothing may be shown
    LaneFloats origin_u;  ///< rows at the VPL, as hit_lanes() wants them
    LaneFloats origin_v;
    LaneFloats origin_s;
    std::uint32_t group;  ///< the triangles are those at 16 group + lane in the hierarchy

    [[nodiscard]] OriginRows origin(std::uint32_t k) const {
        return {origin_u.at[k], origin_v.at[k], origin_s.at[k]};
    }
};

/// Margin of U, V and W of lanes for misses. In units of sigma (1 + |u| + |v| at the apex +
/// gradients times lengths): docs/shaft_proofs.md derives 4.2.
inline constexpr float lane_margin = 4.5f;
/// Share of it that hits need: docs/shaft_proofs.md derives 2.9 of 4.5.
inline constexpr float lane_hit_share = 3.0f / 4.5f;

/// Makes sixteen triangles ready. No point of a cluster that will be asked about is farther from
/// the VPL at `apex` than `spread` in a coordinate, metres.
inline void prepare_lanes(const TriangleLanes& triangles, Vec3 apex, float spread, float sigma,
                          CandidateLanes& lanes) {
    const float sigmas = lane_margin * sigma;
    for (std::uint32_t k = 0; k < lane_count; ++k) {
        const AffineRow s = triangles.s.row(k);
        const AffineRow u = triangles.u.row(k);
        const AffineRow v = triangles.v.row(k);
        const float at_s = row_at(s, apex);
        const float at_u = row_at(u, apex);
        const float at_v = row_at(v, apex);
        lanes.origin_s.at[k] = at_s;
        lanes.origin_u.at[k] = at_u;
        lanes.origin_v.at[k] = at_v;
        const float depth = fabsf(at_s);
        const float gradients = strict::add(l1_of_gradient(u), l1_of_gradient(v));
        const float varied = strict::mul(gradients, strict::add(spread, depth));
        const float at_apex = strict::add(fabsf(at_u), fabsf(at_v));
        const float margin = strict::mul(sigmas, strict::add(1.0f, strict::add(at_apex, varied)));
        const bool usable = static_cast<bool>(static_cast<int>(depth > sigma) &
                                              static_cast<int>(margin <= EdgeMargins::largest));
        lanes.margin.at[k] = usable ? margin : std::numeric_limits<float>::infinity();
        // A plane that is zero everywhere shows nothing.
        const float side = usable ? (at_s > 0.0f ? -1.0f : 1.0f) : 0.0f;
        const AffineRow beyond{side * s.x, side * s.y, side * s.z, side * s.w};
        const AffineRow crossed_u = combine_rows(at_u, beyond, depth, u);
        const AffineRow crossed_v = combine_rows(at_v, beyond, depth, v);
        const AffineRow length{beyond.x, beyond.y, beyond.z, strict::add(beyond.w, depth)};
        lanes.beyond.set(k, beyond);
        lanes.u.set(k, crossed_u);
        lanes.v.set(k, crossed_v);
        lanes.w.set(k, subtract_rows(length, crossed_u, crossed_v));
    }
}

/// occlusion() of all triangles at once, for one cluster.
template <InstructionSet Set = InstructionSet::baseline>
LaneOcclusion occlusion(const CandidateLanes& lanes, const ClusterBox& box, float sigma) {
    const float plane = OcclusionMargins::plane * sigma;
    const Vec3 centre = box.centre;
    const Vec3 half = box.half;
    LaneTruths none;
    LaneTruths full;
    for (std::uint32_t k = 0; k < lane_count; ++k) {
        const auto range = [&](AffineRow row) {
            const float extent = AffineForm{0.0f, {row.x, row.y, row.z}}.extent(half);
            const float value = row_at(row, centre);
            return Vec2(strict::sub(value, extent), strict::add(value, extent));
        };
        const Vec2 s = range(lanes.beyond.row(k));
        const Vec2 u = range(lanes.u.row(k));
        const Vec2 v = range(lanes.v.row(k));
        const Vec2 w = range(lanes.w.row(k));
        const float margin = lanes.margin.at[k];
        const int negative = static_cast<int>(s.y < -plane) | static_cast<int>(u.y < -margin) |
                             static_cast<int>(v.y < -margin) | static_cast<int>(w.y < -margin);
        const float least = lane_hit_share * margin;
        const int positive = static_cast<int>(s.x > plane) & static_cast<int>(u.x > least) &
                             static_cast<int>(v.x > least) & static_cast<int>(w.x > least);
        none.at[k] = -negative;
        full.at[k] = -positive;
    }
    return {bits_of<Set>(none), bits_of<Set>(full)};
}

}  // namespace mir::detail
