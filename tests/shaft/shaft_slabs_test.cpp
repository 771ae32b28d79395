// SPDX-License-Identifier: MIT
#include "mir/shaft/exact/shaft_slabs.hpp"

#include "shaft/shaft_draws.hpp"
#include "support/catch.hpp"
#include "support/segment_box.hpp"

// Children of nodes are judged in long arithmetic. e = 2^-24; M is the magnitude of the scene,
// whose reach all points keep to.

namespace {

using mir::ShaftSlabs;
using mirtest::ShaftDraw;

/// Changes slabs before they are used.
using Change = void (*)(ShaftSlabs&, const ShaftDraw&);

void no_change(ShaftSlabs&, const ShaftDraw&) {}

struct Scale {
    float reach = 0.0f;
    float unit = 0.0f;  ///< e M
};

Scale scale_of(float size) { return {size, 0x1p-24f * size / 1.5f}; }

/// The node of the draw, grown, in a slot among others.
mir::WideNode node_with(const ShaftDraw& d, float grow, std::uint32_t slot) {
    mir::WideNode node;
    for (std::int32_t& count : node.count) count = 1;
    for (std::uint32_t k = 0; k < mir::WideNode::width; ++k)
        for (int axis = 0; axis < 3; ++axis)
            node.set_bounds(axis, k, d.node.low[axis] - (k == slot ? grow : -1.0f),
                            d.node.high[axis] + (k == slot ? grow : 3.0f));
    return node;
}

bool met(const ShaftDraw& d, float grow, Scale scale, Change change, std::uint32_t slot) {
    ShaftSlabs s =
        mir::make_shaft_slabs(d.cluster, d.apex, mirtest::float_sigma(scale.reach), scale.reach);
    change(s, d);
    return (mir::met_slots(node_with(d, grow, slot), s) >> slot & 1u) != 0;
}

struct Wrong {
    std::size_t met = 0;
    std::size_t refused = 0;  ///< of those that are met
};

/// Whether the child is met in a node's quantised boxes, whose planes are moved `inwards`.
bool met_quantised(const ShaftDraw& d, Scale scale, std::uint32_t inwards, std::uint32_t slot) {
    const ShaftSlabs s =
        mir::make_shaft_slabs(d.cluster, d.apex, mirtest::float_sigma(scale.reach), scale.reach);
    mir::QuantisedNode node =
        mir::quantised(node_with(d, 14.0f * scale.unit, slot), 0x1p-20f * scale.reach);
    for (int axis = 0; axis < 3; ++axis)
        for (std::uint32_t w = 0; w < mir::QuantisedNode::words_per_row; ++w) {
            node.rows[mir::QuantisedNode::row_of(axis, false)][w] += inwards * 0x01010101u;
            node.rows[mir::QuantisedNode::row_of(axis, true)][w] -= inwards * 0x01010101u;
        }
    return (mir::met_slots(node, s) >> slot & 1u) != 0;
}

std::size_t quantised_refusals(std::uint32_t inwards, int draws) {
    std::size_t refused = 0;
    mir::Random random = mirtest::test_random(4);
    for (int i = 0; i < draws; ++i) {
        const Scale scale = scale_of(std::pow(10.0f, static_cast<float>(i % 3 - 1) * 3.0f));
        const ShaftDraw d = mirtest::draw_shaft(random, scale.reach);
        if (mirtest::meets(d.node, 0, d.apex, d.luxel) &&
            !met_quantised(d, scale, inwards, static_cast<std::uint32_t>(i) % 8))
            ++refused;
    }
    return refused;
}

/// Of children that hold a point of a segment by `units` of e M, at three scales.
Wrong refusals(float units, Change change, int draws) {
    Wrong wrong;
    mir::Random random = mirtest::test_random(1);
    for (int i = 0; i < draws; ++i) {
        const Scale scale = scale_of(std::pow(10.0f, static_cast<float>(i % 3 - 1) * 3.0f));
        const ShaftDraw d = mirtest::draw_shaft(random, scale.reach);
        if (!mirtest::meets(d.node, 0, d.apex, d.luxel)) continue;
        ++wrong.met;
        if (!met(d, units * scale.unit, scale, change, static_cast<std::uint32_t>(i) % 8))
            ++wrong.refused;
    }
    return wrong;
}

/// Children accepted although they are 10^-3 of the way apart, even grown by twice the slack.
std::size_t loosely_accepted(Change change, int draws) {
    std::size_t count = 0;
    mir::Random random = mirtest::test_random(2);
    const Scale scale = scale_of(1.0f);
    for (int i = 0; i < draws; ++i) {
        ShaftDraw d = mirtest::draw_shaft(random, scale.reach);
        const mir::Vec3 aside = 0.1f * random.next() * mirtest::point_in_cube(random);
        ShaftDraw grown = d;
        grown.node.low += aside - 28.0f * scale.unit;
        grown.node.high += aside + 28.0f * scale.unit;
        d.node.low += aside;
        d.node.high += aside;
        if (mirtest::gap(grown) > 1e-3L && met(d, 0.0f, scale, change, 3)) ++count;
    }
    return count;
}

void wrong_sign(ShaftSlabs& s, const ShaftDraw&) { s.fars[0].inverse = -s.fars[0].inverse; }

void straddling_axis_ends(ShaftSlabs& s, const ShaftDraw&) {
    for (int axis = 0; axis < 3; ++axis)
        if (s.others[axis].inverse != 0.0f) s.fars[axis] = s.others[axis];
}

void planes_exchanged(ShaftSlabs& s, const ShaftDraw&) { s.near_plane[1] ^= 1u; }

/// The reciprocal's sign from a difference that may be a zero of either sign.
void sign_of_difference(ShaftSlabs& s, const ShaftDraw& d) {
    for (int axis = 0; axis < 3; ++axis)
        if (d.cluster.low[axis] == d.apex[axis]) s.fars[axis].inverse = -s.fars[axis].inverse;
}

void without_others(ShaftSlabs& s, const ShaftDraw&) { s.straddles = false; }

void without_far_planes(ShaftSlabs& s, const ShaftDraw&) {
    for (mir::detail::AxisStep& step : s.fars) step = {0.0f, -1.0f};
}

}  // namespace

TEST_CASE("No slabs refuse a child that holds a point of a segment by 14 e M") {
    const Wrong wrong = refusals(14.0f, no_change, 1000000);
    CHECK(wrong.met > 900000);
    CHECK(wrong.refused == 0);
}

TEST_CASE("Slabs without slack or changed by mistakes refuse children that are met") {
    CHECK(refusals(0.0f, no_change, 200000).refused > 1000);
    CHECK(refusals(14.0f, wrong_sign, 200000).refused > 1000);
    CHECK(refusals(14.0f, straddling_axis_ends, 200000).refused > 1000);
    CHECK(refusals(14.0f, planes_exchanged, 200000).refused > 1000);
    CHECK(refusals(14.0f, sign_of_difference, 200000).refused > 1000);
}

TEST_CASE("Slabs refuse every child that they miss by a thousandth of the way") {
    CHECK(loosely_accepted(no_change, 500000) == 0);
    CHECK(loosely_accepted(without_others, 200000) > 500);
    CHECK(loosely_accepted(without_far_planes, 200000) > 1000);
}

TEST_CASE("No slabs refuse a child of quantised boxes that holds a point of a segment") {
    CHECK(quantised_refusals(0, 500000) == 0);
    CHECK(quantised_refusals(1, 200000) > 100);
    CHECK(quantised_refusals(2, 200000) > 1000);
}

TEST_CASE("Slabs keep the half-space of the shaft") {
    mir::Random random = mirtest::test_random(3);
    std::size_t refused = 0;
    for (int i = 0; i < 100000; ++i) {
        ShaftDraw d = mirtest::draw_shaft(random, 1.0f);
        const mir::Vec3 n = mirtest::point_in_cube(random);
        d.cluster.front = {n.x, n.y, n.z, 0.1f - glm::dot(n, d.luxel)};
        const mir::Vec3 aside = mirtest::point_in_cube(random);
        d.node.low += aside;
        d.node.high += aside;
        const ShaftSlabs slabs = mir::make_shaft_slabs(d.cluster, d.apex, 1e-6f, 1.0f);
        const mir::Shaft shaft = mir::make_shaft(d.cluster, d.apex, 1e-6f);
        const bool in_front = mir::detail::in_front(shaft.front, d.node.low, d.node.high);
        const mir::AffineRow f = shaft.front;
        const mir::Vec3 corner(f.x > 0 ? d.node.high.x : d.node.low.x,
                               f.y > 0 ? d.node.high.y : d.node.low.y,
                               f.z > 0 ? d.node.high.z : d.node.low.z);
        if (std::fabs(mir::row_at(f, corner)) < 1e-6f) continue;  // decided by rounding
        const float value = mir::detail::front_values(node_with(d, 0.0f, 5), slabs)[5];
        REQUIRE((value >= 0.0f) == in_front);
        if (!in_front) ++refused;
    }
    CHECK(refused > 1000);
}
