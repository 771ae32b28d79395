// SPDX-License-Identifier: MIT
#include "accel/wide_nodes.hpp"
#include "conformance/worlds.hpp"
#include "mir/accel/wide/detail/packet_hull.hpp"
#include "mir/accel/wide/wide_packet.hpp"
#include "mir/accel/wide/wide_traverse.hpp"
#include "support/catch.hpp"
#include "support/instruction_sets.hpp"
#include "support/packet_points.hpp"
#include "support/scene_places.hpp"
#include "support/segment_box.hpp"
#include "support/segment_ends.hpp"

namespace {

using mir::Bounds;
using mir::Vec3;
using mirtest::SegmentEnds;

/// A packet two of whose lanes are judged; they may be the same.
struct HardPacket {
    mir::PointPacket points;
    std::uint32_t lane;
    std::uint32_t other;

    [[nodiscard]] std::uint32_t judged() const { return 1u << lane | 1u << other; }
};

/// Makes boxes in [-scale, scale]^3, and segments in 1.5 times that cube, mostly aimed at the
/// faces, edges and corners of a box.
class HardBoxes {
 public:
    HardBoxes(float scale, std::uint64_t index)
        : scale_(scale), random_(mirtest::test_random(index)) {}

    mir::WideNode node() {
        mir::WideNode node{};
        for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot) {
            const Vec3 a = point();
            Vec3 b = random_.next() < 0.5f ? point() : a + 0.01f * point();
            if (random_.next() < 0.2f) {
                const int k = axis();
                b[k] = a[k];
            }
            for (int k = 0; k < 3; ++k)
                node.set_bounds(k, slot, std::max(std::min(a[k], b[k]), -scale_),
                                std::min(std::max(a[k], b[k]), scale_));
        }
        return node;
    }

    /// A packet one of whose lanes ends at `to`, the others close by or anywhere.
    HardPacket packet(Vec3 to) {
        HardPacket packet;
        packet.lane = mirtest::random_index(random_, mir::PointPacket::width);
        packet.other = mirtest::random_index(random_, mir::PointPacket::width);
        const float size = random_.next() < 0.5f ? 1.5f * scale_ : 0.01f * scale_;
        for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k) {
            Vec3 p = kept(to + size * mirtest::point_in_cube(random_));
            if (random_.next() < 0.2f) {
                const int flat = axis();
                p[flat] = to[flat];
            }
            mirtest::set_point(packet.points, k, k == packet.lane ? to : p);
        }
        return packet;
    }

    SegmentEnds segment(const Bounds& box) {
        const Vec3 at = on(box);
        SegmentEnds s{1.5f * point(), 1.5f * point()};
        switch (kind_++ % 6) {
            case 0:
                return s;
            case 1:  // through a face, an edge or a corner
                s.to = s.from + (1.0f + random_.next()) * (at - s.from);
                s.to = kept(s.to);
                return s;
            case 2:  // ends there
                s.to = at;
                return s;
            case 3:  // along an axis
                s.from = at;
                s.to = at;
                s.to[axis()] = 1.5f * scale_ * (2.0f * random_.next() - 1.0f);
                return s;
            case 4:  // almost along an axis
                s.from = at;
                s.to = at + scale_ * 0x1p-40f * mirtest::point_in_cube(random_);
                s.to[axis()] = 1.5f * scale_ * (2.0f * random_.next() - 1.0f);
                return s;
            default:  // from one such place to another
                s.from = at;
                s.to = on(box);
                return s;
        }
    }

 private:
    Vec3 point() { return scale_ * mirtest::point_in_cube(random_); }
    int axis() { return static_cast<int>(mirtest::random_index(random_, 3)); }
    Vec3 kept(Vec3 p) const { return glm::clamp(p, Vec3(-1.5f * scale_), Vec3(1.5f * scale_)); }

    /// On a face, edge or corner but for some units in the last place.
    Vec3 on(const Bounds& box) {
        Vec3 p = box.low + random_.next() * (box.high - box.low);
        for (int k = 0; k < 3; ++k) {
            const float choice = random_.next();
            if (choice < 0.3f) p[k] = box.low[k];
            if (choice > 0.7f) p[k] = box.high[k];
        }
        p += 8.0f * 0x1p-24f * scale_ * mirtest::point_in_cube(random_);
        return kept(p);
    }

    float scale_;
    mir::Random random_;
    std::uint32_t kind_ = 0;
};

/// Calls judge(boxes, node, slot, box, segment) for each child of `nodes` nodes, and a segment made
/// for it.
template <class Judge>
void judge_boxes(float scale, std::size_t nodes, std::uint64_t index, const Judge& judge) {
    HardBoxes boxes(scale, index);
    for (std::size_t i = 0; i < nodes; ++i) {
        const mir::WideNode node = boxes.node();
        for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot) {
            const Bounds box = mirtest::child_of(node, slot).box;
            judge(boxes, node, slot, box, boxes.segment(box));
        }
    }
}

/// By how much a segment has to meet a box that may not be culled, metres.
long double reserved_at(float scale) { return 14.0L * 0x1p-24L * scale; }

struct Verdicts {
    std::size_t met = 0;            ///< boxes met by the segment
    std::size_t culled_inside = 0;  ///< although met by more than is reserved
    std::size_t culled_met = 0;     ///< although met
    std::size_t kept_outside = 0;   ///< although missed by more than is reserved

    void add(const Bounds& box, const SegmentEnds& s, bool kept, long double reserved) {
        const bool is_met = mirtest::meets(box, 0, s.from, s.to);
        met += is_met ? 1 : 0;
        culled_met += is_met && !kept ? 1 : 0;
        if (!kept && mirtest::meets(box, -reserved, s.from, s.to)) ++culled_inside;
        if (kept && !mirtest::meets(box, reserved, s.from, s.to)) ++kept_outside;
    }
};

Verdicts judge(float scale, std::size_t nodes, std::uint64_t index) {
    Verdicts verdicts;
    judge_boxes(scale, nodes, index,
                [&](HardBoxes&, const mir::WideNode& node, std::uint32_t slot, const Bounds& box,
                    const SegmentEnds& s) {
                    const mir::detail::SlabSegment segment(s.from, s.to, mir::reach_of(scale));
                    const auto found = mir::detail::met_children(node, segment, 1.0f);
                    verdicts.add(box, s, (found.mask >> slot & 1u) != 0, reserved_at(scale));
                });
    return verdicts;
}

/// Of two lanes of a packet, when only those are active and when all are.
template <mir::InstructionSet Set>
Verdicts judge_lanes(float scale, std::size_t nodes, std::uint64_t index) {
    Verdicts verdicts;
    judge_boxes(scale, nodes, index,
                [&](HardBoxes& boxes, const mir::WideNode& node, std::uint32_t slot,
                    const Bounds& box, const SegmentEnds& s) {
                    const HardPacket packet = boxes.packet(s.to);
                    for (const std::uint32_t active : {packet.judged(), 0xFFFFu}) {
                        mir::detail::PacketSlabs<Set> slabs;
                        slabs.set(s.from, packet.points, active, mir::reach_of(scale));
                        const std::uint32_t kept = slabs.meet(node, slot);
                        for (const std::uint32_t k : {packet.lane, packet.other})
                            verdicts.add(box, {s.from, mirtest::point_of(packet.points, k)},
                                         (kept >> k & 1u) != 0, reserved_at(scale));
                    }
                });
    return verdicts;
}

/// Of packets with such segments, whose hulls, around the judged lanes and around all, are each
/// asked about one box.
struct HullVerdicts {
    std::size_t kept = 0;
    std::size_t culled = 0;
    std::size_t culled_inside = 0;  ///< although a segment meets the box by more than is reserved
};

template <mir::InstructionSet Set>
HullVerdicts judge_hulls(float scale, std::size_t nodes, std::uint64_t index) {
    HullVerdicts verdicts;
    judge_boxes(scale, nodes, index,
                [&](HardBoxes& boxes, const mir::WideNode& node, std::uint32_t slot,
                    const Bounds& box, const SegmentEnds& s) {
                    const HardPacket packet = boxes.packet(s.to);
                    for (const std::uint32_t active : {packet.judged(), 0xFFFFu}) {
                        const mir::detail::PacketHull hull(s.from, packet.points, active,
                                                           mir::reach_of(scale));
                        const bool kept = (hull.met<Set>(node) >> slot & 1u) != 0;
                        verdicts.kept += kept ? 1 : 0;
                        verdicts.culled += kept ? 0 : 1;
                        if (kept) continue;
                        for (const std::uint32_t k : {packet.lane, packet.other})
                            if (mirtest::meets(box, -reserved_at(scale), s.from,
                                               mirtest::point_of(packet.points, k)))
                                ++verdicts.culled_inside;
                    }
                });
    return verdicts;
}

}  // namespace

TEST_CASE("The hull of a packet keeps boxes that a segment meets by more than is reserved",
          "[slow]") {
    const float scale = GENERATE(1e-3f, 1.0f, 24.0f, 1e3f, 1e12f, 1e36f);
    for (const mir::InstructionSet set : mirtest::instruction_sets())
        mir::run_with(set, [&](auto s) {
            const HullVerdicts verdicts = judge_hulls<decltype(s)::value>(scale, 30000, 2);
            INFO("scale " << scale << ", instruction set " << static_cast<int>(set));
            CHECK(verdicts.culled_inside == 0);
            CHECK(verdicts.kept > 50000);
            CHECK(verdicts.culled > 50000);
        });
}

TEST_CASE("The hull of a packet is no larger than its segments need") {
    mir::PointPacket points{};
    for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k) {
        points.x[k] = 8.0f;
        points.y[k] = static_cast<float>(k % 4) - 1.0f;
        points.z[k] = -static_cast<float>(k / 4);
    }
    mir::WideNode node{};
    // Beside the segments on either side, behind the points, behind the origin; then inside, at
    // the origin, at the last point, and where only lane 15 goes.
    const float low[8][3] = {{4, 1.2f, -1}, {4, -1.2f, -1}, {9, 0, 0},        {-2, 0, 0},
                             {4, 0.5f, -1}, {0, 0, 0},      {7.9f, 1.5f, -3}, {7.5f, 1.4f, -2.9f}};
    for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot)
        for (int axis = 0; axis < 3; ++axis)
            node.set_bounds(axis, slot, low[slot][axis], low[slot][axis] + 0.5f);
    const auto met = [&](std::uint32_t active) {
        return mir::detail::PacketHull({0, 0, 0}, points, active, 24.0f)
            .met<mir::InstructionSet::baseline>(node);
    };
    CHECK(met(0xFFFF) == 0b11110000);
    CHECK(met(0x7FFF) == 0b11110000);  // others reach as far along each axis
    CHECK(met(0x0001) == 0b00100000);
}

TEST_CASE("A box is kept when a segment meets it by more than is reserved, else it may be culled",
          "[slow]") {
    const float scale = GENERATE(1e-3f, 1.0f, 24.0f, 1e3f, 1e12f, 1e36f);
    const Verdicts verdicts = judge(scale, 100000, 1);
    INFO("scale " << scale << ", " << verdicts.met << " met");
    CHECK(verdicts.met > 200000);
    CHECK(verdicts.met < 600000);
    CHECK(verdicts.culled_inside == 0);
    CHECK(verdicts.kept_outside == 0);
    // Without the slack that accept boxes bring along, boxes that are met would be lost.
    CHECK(verdicts.culled_met > 0);
}

TEST_CASE("Lanes of a packet keep and cull boxes within what is reserved", "[slow]") {
    const float scale = GENERATE(1e-3f, 1.0f, 24.0f, 1e3f, 1e12f, 1e36f);
    for (const mir::InstructionSet set : mirtest::instruction_sets())
        mir::run_with(set, [&](auto s) {
            const Verdicts verdicts = judge_lanes<decltype(s)::value>(scale, 10000, 3);
            INFO("scale " << scale << ", instruction set " << static_cast<int>(set));
            CHECK(verdicts.met > 50000);
            CHECK(verdicts.met < 250000);
            CHECK(verdicts.culled_inside == 0);
            CHECK(verdicts.kept_outside == 0);
            CHECK(verdicts.culled_met > 0);
        });
}

TEST_CASE("A child begins where the segment enters it, and none is met behind the end") {
    mir::WideNode node{};
    for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot) {
        const auto low = static_cast<float>(slot);
        const float planes[6] = {low, low + 0.5f, -1, 1, -1, 1};
        for (int k = 0; k < 6; ++k) node.planes[k][slot] = planes[k];
    }
    const mir::detail::SlabSegment segment({-1, 0, 0}, {9, 0, 0}, 15.0f);
    const auto all = mir::detail::met_children(node, segment, 1.0f);
    CHECK(all.mask == 0xFF);
    for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot)
        CHECK(all.begin[slot] == mirtest::Approx((slot + 1.0) / 10.0));
    CHECK(mir::detail::met_children(node, segment, 0.45f).mask == 0x0F);
    const mir::detail::SlabSegment back({9, 0, 0}, {-1, 0, 0}, 15.0f);
    CHECK(mir::detail::met_children(node, back, 0.47f).mask == 0xF0);
}

TEST_CASE("Children leave their queue in the order of distance, equal ones in that of insertion") {
    const float begin[8] = {0.5f, 0.25f, 0.75f, 0.25f, 0.0f, 1.0f, 0.5f, 0.125f};
    mir::detail::ChildQueue queue{0};
    CHECK(queue.empty());
    for (std::uint32_t slot = 0; slot < 8; ++slot) queue.insert(slot, begin);
    for (std::uint32_t slot : {4u, 7u, 1u, 3u, 0u, 6u, 2u, 5u}) {
        CHECK_FALSE(queue.empty());
        CHECK(queue.pop() == slot);
    }
    CHECK(queue.empty());
}
