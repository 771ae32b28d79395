// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/exact/cluster_record.hpp"
#include "mir/shaft/exact/shadow_planes.hpp"

namespace mir {

/// What one triangle does to the segments of a VPL and a box. The box holds the points of a
/// cluster; hits_segment() decides.
enum class Occlusion : std::uint8_t {
    none,     ///< it hits none of them
    partial,  ///< neither is shown
    full      ///< it hits all of them
};

/// A VPL and the box of a cluster, as triangles are tested against them. Without defaults, and
/// aligned so that the device moves it as whole words.
struct alignas(16) Pyramid {
    Vec3 apex;           ///< the VPL, metres
    float spread;        ///< no coordinate of a point of the box is farther from the VPL's, metres
    Vec3 centre;         ///< of the box, up to rounding
    float sigma;         ///< of the scene, metres
    Vec3 half;           ///< half edges: the box keeps within -+ half of local coordinates
    std::uint32_t axis;  ///< that leans: TiltedAxis
    Vec3 slope;          ///< as above

    /// Local coordinates: the difference from the centre. On the axis that leans it is that from
    /// the tilted plane through the centre.
    [[nodiscard]] MIR_HD Vec3 local(Vec3 p) const {
        Vec3 d = p - centre;
        const float rise = detail::loose_dot(slope, d);
        if (axis == 0) d.x -= rise;
        if (axis == 1) d.y -= rise;
        if (axis == 2) d.z -= rise;
        return d;
    }
    /// Gradient in local coordinates of a function whose gradient is `g`.
    [[nodiscard]] MIR_HD Vec3 local_gradient(Vec3 g) const {
        const float own = axis == 0 ? g.x : axis == 1 ? g.y : g.z;
        return {loose::mul_add(own, slope.x, g.x), loose::mul_add(own, slope.y, g.y),
                loose::mul_add(own, slope.z, g.z)};
    }
};

/// Pyramid of a cluster that has luxels and a VPL at `apex`, metres. `sigma` as for the cluster.
[[nodiscard]] MIR_HD inline Pyramid make_pyramid(const ClusterRecord& cluster, Vec3 apex,
                                                 float sigma) {
    Pyramid p;
    p.apex = apex;
    p.centre = 0.5f * (cluster.low + cluster.high);
    p.half = glm::max(cluster.high - p.centre, p.centre - cluster.low);
    p.spread = larger(max_abs(cluster.low - apex), max_abs(cluster.high - apex));
    p.sigma = sigma;
    p.axis = cluster.tilt.axis;
    p.slope = cluster.tilt.slope;
    if (p.axis == TiltedAxis::none) return p;
    const float middle = 0.5f * (cluster.tilt.low + cluster.tilt.high);
    const float half = larger(cluster.tilt.high - middle, middle - cluster.tilt.low);
    const float up = strict::sub(middle, cluster.tilt.along(p.centre));
    const Vec3 own(p.axis == 0 ? 1.0f : 0.0f, p.axis == 1 ? 1.0f : 0.0f, p.axis == 2 ? 1.0f : 0.0f);
    p.centre += up * own;
    p.half = glm::mix(p.half, Vec3(half), own);
    return p;
}

/// How far from 0 a bound must be for hits_segment() to agree. The distance from the plane is in
/// units of sigma, the edges in those of edge_margins(). docs/shaft_proofs.md derives 1.94 of the
/// 2, 2.49 of the 2.5 for misses and 0.992 of the 1 for hits.
struct OcclusionMargins {
    static constexpr float plane = 2.0f;      ///< of the distance from the plane
    static constexpr float edge = 2.5f;       ///< of U, V and W, to be sure of a miss
    static constexpr float hit_share = 0.4f;  ///< what hits need of it
};

namespace detail {

/// An affine function over a box: value in the centre and gradient.
struct AffineForm {
    float value = 0.0f;
    Vec3 slope{0};

    /// Largest difference from `value` in a box of half edges `half`.
    [[nodiscard]] MIR_HD float extent(Vec3 half) const {
        return loose_dot({fabsf(slope.x), fabsf(slope.y), fabsf(slope.z)}, half);
    }
};

/// In local coordinates.
MIR_HD inline AffineForm affine_form(AffineRow row, const Pyramid& p) {
    return {loose_at(row, p.centre), p.local_gradient({row.x, row.y, row.z})};
}

/// The same function as a row.
MIR_HD inline PlainRow row_from_centre(const AffineForm& f) {
    return {f.slope.x, f.slope.y, f.slope.z, f.value};
}

MIR_HD inline AffineRow negated(AffineRow row) { return {-row.x, -row.y, -row.z, -row.w}; }

/// a f + b g
MIR_HD inline AffineForm combine(float a, const AffineForm& f, float b, const AffineForm& g) {
    const auto mix = [a, b](float x, float y) { return loose::mul_add(a, x, strict::mul(b, y)); };
    return {mix(f.value, g.value),
            {mix(f.slope.x, g.slope.x), mix(f.slope.y, g.slope.y), mix(f.slope.z, g.slope.z)}};
}

/// f - g
MIR_HD inline AffineForm subtract(const AffineForm& f, const AffineForm& g) {
    return {strict::sub(f.value, g.value),
            {strict::sub(f.slope.x, g.slope.x), strict::sub(f.slope.y, g.slope.y),
             strict::sub(f.slope.z, g.slope.z)}};
}

/// Where an affine function keeps its sign: all of it beyond a margin.
struct SureSign {
    bool negative = false;
    bool positive = false;
};

MIR_HD inline SureSign sure_sign(const AffineForm& f, Vec3 half, float below, float above) {
    const float extent = f.extent(half);
    return {strict::add(f.value, extent) < -below, strict::sub(f.value, extent) > above};
}

/// The VPL as a triangle's rows see it.
struct ApexRows {
    float u = 0.0f;
    float v = 0.0f;
    float depth = 0.0f;  ///< distance from the plane, metres
};

/// Margins of U, V and W, metres, `sigma` a multiple of the scene's.
MIR_HD inline EdgeMargins edge_margins(const TriangleRows& rows, const Pyramid& p,
                                       const ApexRows& apex, float sigma) {
    const float reach = strict::add(p.spread, apex.depth);
    const float u = fabsf(apex.u);
    const float v = fabsf(apex.v);
    const float varied_u = strict::mul(l1_of_gradient(rows.u), reach);
    const float varied_v = strict::mul(l1_of_gradient(rows.v), reach);
    const float at_apex = loose::mul_add(5.0f, strict::add(u, v), 5.0f);
    return {strict::mul(sigma, loose::mul_add(4.0f, u, varied_u)),
            strict::mul(sigma, loose::mul_add(4.0f, v, varied_v)),
            strict::mul(sigma, loose::mul_add(2.0f, strict::add(varied_u, varied_v), at_apex))};
}

/// Whether all segments that cross a plane agree about edges. They pass outside of the same edge
/// (negative) or inside all edges (positive). S is the VPL's depth, s'(p) the distance of p beyond
/// the plane. With U(p) = u(q) s'(p) + S u(p), V(p) = v(q) s'(p) + S v(p), W(p) = s'(p) + S - U(p)
/// - V(p) the segment to p crosses inside when none is negative. They are affine in p, so their
/// ranges over a box are known. Fills `planes`; inside it asks for `hit` of the margins.
MIR_HD inline SureSign sure_edges(const TriangleRows& rows, const Pyramid& p,
                                  const AffineForm& beyond, const ApexRows& apex,
                                  EdgeMargins margins, float hit, ShadowPlanes& planes) {
    const AffineForm u = combine(apex.u, beyond, apex.depth, affine_form(rows.u, p));
    const AffineForm v = combine(apex.v, beyond, apex.depth, affine_form(rows.v, p));
    const AffineForm d{strict::add(beyond.value, apex.depth), beyond.slope};
    const AffineForm w = subtract(subtract(d, u), v);
    planes = {row_from_centre(beyond), row_from_centre(u), row_from_centre(v), row_from_centre(w),
              margins};
    const SureSign edge_u = sure_sign(u, p.half, margins.u, hit * margins.u);
    const SureSign edge_v = sure_sign(v, p.half, margins.v, hit * margins.v);
    const SureSign edge_w = sure_sign(w, p.half, margins.w, hit * margins.w);
    return {edge_u.negative || edge_v.negative || edge_w.negative,
            edge_u.positive && edge_v.positive && edge_w.positive};
}

}  // namespace detail

/// Tests one triangle against all segments of a pyramid. They go from the apex to its box,
/// in about 100 operations without a division. None is left out early: lanes of a device
/// that test different triangles would wait for the one that needs them all. Partial when
/// the apex lies within sigma of the triangle's plane. Source: Reshetov, "Faster ray
/// packets - triangle intersection through vertex culling", 2007, turned round: affine
/// functions of the triangle over the base instead of planes over vertices. `planes` say
/// what is sure of single segments: where the apex is that near, misses by the plane
/// alone.
template <class Margins = OcclusionMargins>
[[nodiscard]] MIR_HD Occlusion occlusion(const TriangleRows& rows, const Pyramid& p,
                                         ShadowPlanes& planes) {
    const float s = row_at(rows.s, p.apex);
    const float depth = fabsf(s);
    const bool is_near = !(depth > p.sigma);
    const detail::AffineForm beyond =
        detail::affine_form(s > 0.0f ? detail::negated(rows.s) : rows.s, p);
    const float plane_margin = Margins::plane * p.sigma;
    const detail::SureSign plane = detail::sure_sign(beyond, p.half, plane_margin, plane_margin);
    const detail::ApexRows apex{detail::loose_at(rows.u, p.apex), detail::loose_at(rows.v, p.apex),
                                depth};
    // Where the apex is near no edge is sure.
    const float sigma = is_near ? INFINITY : Margins::edge * p.sigma;
    const EdgeMargins margins = detail::edge_margins(rows, p, apex, sigma);
    const detail::SureSign edges =
        detail::sure_edges(rows, p, beyond, apex, margins, Margins::hit_share, planes);
    // Sums of products that overflow have any sign.
    const bool is_bounded = margins.w <= EdgeMargins::largest;
    if (is_near) return Occlusion::partial;
    if (plane.negative || (is_bounded && edges.negative)) return Occlusion::none;
    return is_bounded && plane.positive && edges.positive ? Occlusion::full : Occlusion::partial;
}

/// The same where single segments are not asked about.
template <class Margins = OcclusionMargins>
[[nodiscard]] MIR_HD Occlusion occlusion(const TriangleRows& rows, const Pyramid& p) {
    ShadowPlanes planes;
    return occlusion<Margins>(rows, p, planes);
}

}  // namespace mir
