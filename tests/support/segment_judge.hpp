// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/referee.hpp"
#include "support/segment_ends.hpp"

#include <array>
#include <vector>

namespace mirtest {

/// What double precision says about a segment: how far it is from being decided otherwise, in units
/// of the largest rounding of hits_segment(). Positive: hidden. Above 1 hits_segment() cannot say
/// visible, below -1 it cannot say hidden; in between either answer is right.
struct Judgement {
    double margin = -std::numeric_limits<double>::infinity();
    bool at_end = false;  ///< an end's distance from a plane decides, not one from an edge

    [[nodiscard]] bool hidden() const { return margin >= 0.0; }
    [[nodiscard]] bool within_rounding() const { return std::fabs(margin) <= 1.0; }
};

/// Settles disagreements about visibility by asking every triangle in double precision, with the
/// rounding bounds of the lemma in mir/accel/exact/accept_box.hpp: 17 e M for distances from
/// planes, 13 e M and 18 e M for barycentrics, where M is the largest |coordinate| and e = 2^-24.
/// Written apart from the code that it judges. The geometry must outlive it. Const use from any
/// thread.
class SegmentJudge {
 public:
    explicit SegmentJudge(const mir::WorldGeometry& geometry);

    /// Ends must be within 1.5 M.
    [[nodiscard]] Judgement judge(const SegmentEnds& s) const;

 private:
    static constexpr std::uint32_t group_size = 64;

    /// Box around all places at which a margin above -1 is possible, metres.
    struct Box {
        std::array<double, 3> low{};
        std::array<double, 3> high{};

        void add(Double3 p, double around);
        void add(const Box& other);
        [[nodiscard]] bool is_met(const SegmentEnds& s) const;
    };
    /// A triangle's plane and barycentric coordinates as gradients, from its first corner.
    struct Frame {
        Double3 corner, normal, u, v;
        double longest = 0.0;  ///< bound of the edges' lengths
    };

    [[nodiscard]] Frame frame_of(std::uint32_t t) const;
    [[nodiscard]] Box box_of(std::uint32_t t) const;
    [[nodiscard]] Judgement judge(const Frame& f, const SegmentEnds& s) const;

    const mir::WorldGeometry* geometry_;
    double unit_ = 0.0;        ///< e M
    std::vector<Box> boxes_;   ///< of triangles
    std::vector<Box> groups_;  ///< of group_size triangles in a row
};

namespace detail {

inline double l1(Double3 v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }
inline Double3 divided(Double3 v, double by) { return {v.x / by, v.y / by, v.z / by}; }
inline constexpr double no_limit = std::numeric_limits<double>::infinity();

}  // namespace detail

inline SegmentJudge::SegmentJudge(const mir::WorldGeometry& geometry) : geometry_(&geometry) {
    for (mir::Vec3 p : geometry.positions())
        for (int axis = 0; axis < 3; ++axis)
            unit_ = std::max(unit_, 0x1p-24 * std::fabs(static_cast<double>(p[axis])));
    for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t) {
        boxes_.push_back(box_of(t));
        if (t % group_size == 0) groups_.push_back(boxes_.back());
        groups_.back().add(boxes_.back());
    }
}

inline void SegmentJudge::Box::add(Double3 p, double around) {
    const std::array<double, 3> at{p.x, p.y, p.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], at[axis] - around);
        high[axis] = std::max(high[axis], at[axis] + around);
    }
}

inline void SegmentJudge::Box::add(const Box& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], other.low[axis]);
        high[axis] = std::max(high[axis], other.high[axis]);
    }
}

inline bool SegmentJudge::Box::is_met(const SegmentEnds& s) const {
    double begin = 0.0;
    double end = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double from = s.from[static_cast<int>(axis)];
        const double way = static_cast<double>(s.to[static_cast<int>(axis)]) - from;
        if (way == 0.0) {
            if (from < low[axis] || from > high[axis]) return false;
            continue;
        }
        const double a = (low[axis] - from) / way;
        const double b = (high[axis] - from) / way;
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return begin <= end;
}

inline SegmentJudge::Frame SegmentJudge::frame_of(std::uint32_t t) const {
    const Double3 a(geometry_->corner(t, 0));
    const Double3 e1 = Double3(geometry_->corner(t, 1)) - a;
    const Double3 e2 = Double3(geometry_->corner(t, 2)) - a;
    const Double3 n = cross(e1, e2);
    const double squared = dot(n, n);
    return {a, detail::divided(n, std::sqrt(squared)), detail::divided(cross(e2, n), squared),
            detail::divided(cross(n, e1), squared), detail::l1(e1) + detail::l1(e2)};
}

/// Barycentrics may be off by their bounds, which moves a point along the edges.
inline SegmentJudge::Box SegmentJudge::box_of(std::uint32_t t) const {
    const Frame f = frame_of(t);
    const double steep = detail::l1(f.u) + detail::l1(f.v);
    double around = 100.0 * unit_ * (1.0 + steep * f.longest) + 0x1p-20 * f.longest;
    if (!std::isfinite(around)) around = detail::no_limit;
    Box box;
    box.low.fill(detail::no_limit);
    box.high.fill(-detail::no_limit);
    for (std::uint32_t k = 0; k < 3; ++k) box.add(Double3(geometry_->corner(t, k)), around);
    return box;
}

inline Judgement SegmentJudge::judge(const SegmentEnds& s) const {
    Judgement deepest;
    const auto count = static_cast<std::uint32_t>(boxes_.size());
    for (std::uint32_t g = 0; g < groups_.size(); ++g) {
        if (!groups_[g].is_met(s)) continue;
        const std::uint32_t last = std::min(count, (g + 1) * group_size);
        for (std::uint32_t t = g * group_size; t < last; ++t) {
            if (!boxes_[t].is_met(s)) continue;
            const Judgement j = judge(frame_of(t), s);
            if (j.margin > deepest.margin) deepest = j;
        }
    }
    return deepest;
}

/// The lemma knows the crossing only to where the plane is 17 e M away, so a barycentric coordinate
/// is as uncertain as it changes on that part of the segment.
inline Judgement SegmentJudge::judge(const Frame& f, const SegmentEnds& s) const {
    const Double3 from = Double3(s.from) - f.corner;
    const Double3 to = Double3(s.to) - f.corner;
    const double s_from = dot(f.normal, from);
    const double s_to = dot(f.normal, to);
    const double way = s_from - s_to;
    const double plane = 17.0 * unit_;
    const double share = way == 0.0 ? 0.5 : std::min(1.0, std::max(0.0, s_from / way));
    const double unsure = std::min(1.0, plane / std::fabs(way));
    const auto inside = [&](double at_from, double at_to, double bound) {
        const double change = at_to - at_from;
        return (at_from + share * change) / (bound + unsure * std::fabs(change));
    };
    const double u_from = dot(f.u, from), v_from = dot(f.v, from);
    const double u_to = dot(f.u, to), v_to = dot(f.v, to);
    const double g_u = detail::l1(f.u), g_v = detail::l1(f.v);
    const double edges = std::min(
        {inside(u_from, u_to, 13.0 * unit_ * g_u), inside(v_from, v_to, 13.0 * unit_ * g_v),
         inside(1.0 - u_from - v_from, 1.0 - u_to - v_to, 18.0 * unit_ * (g_u + g_v) + 0x1p-23)});
    const double ends = std::max(std::min(s_from, -s_to), std::min(-s_from, s_to)) / plane;
    return {std::min(edges, ends), ends < edges};
}

}  // namespace mirtest
