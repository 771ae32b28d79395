// SPDX-License-Identifier: MIT
#include "mir/shaft/exact/shaft.hpp"

#include "shaft/shaft_draws.hpp"
#include "support/catch.hpp"
#include "support/segment_box.hpp"

// Segments are judged in long arithmetic: no shaft may refuse a box that one of its segments meets.

namespace {

using mir::ClusterRecord;
using mir::Shaft;
using mir::Vec3;
using mirtest::gap;
using mirtest::ShaftDraw;

using MakeShaft = Shaft (*)(const ClusterRecord&, Vec3, float);

struct Wrong {
    std::size_t met = 0;
    std::size_t refused = 0;  ///< of those that are met
};

/// Of draws at three scales.
template <class Slack = mir::FloatPlaneSlack>
Wrong refusals(MakeShaft make, int draws) {
    Wrong wrong;
    mir::Random random = mirtest::test_random(1);
    for (int i = 0; i < draws; ++i) {
        const float scale = std::pow(10.0f, static_cast<float>(i % 3 - 1) * 3.0f);
        const ShaftDraw d = mirtest::draw_shaft(random, scale);
        if (!mirtest::meets(d.node, 0, d.apex, d.luxel)) continue;
        ++wrong.met;
        const Shaft shaft = make(d.cluster, d.apex, mirtest::float_sigma(scale));
        if (!mir::meets_box<Slack>(shaft, d.node.low, d.node.high)) ++wrong.refused;
    }
    return wrong;
}

/// Boxes accepted although they are 10^-3 of the way apart.
std::size_t loosely_accepted(MakeShaft make, int draws) {
    std::size_t count = 0;
    mir::Random random = mirtest::test_random(2);
    for (int i = 0; i < draws; ++i) {
        ShaftDraw d = mirtest::draw_shaft(random, 1.0f);
        const Vec3 aside = 0.1f * random.next() * mirtest::point_in_cube(random);
        d.node.low += aside;
        d.node.high += aside;
        const Shaft shaft = make(d.cluster, d.apex, mirtest::float_sigma(1.0f));
        if (gap(d) > 1e-3L && mir::meets_box(shaft, d.node.low, d.node.high)) ++count;
    }
    return count;
}

struct NoSlack {
    static constexpr float relative = 1.0f;
    static constexpr float absolute = 0.0f;
};

/// Changes the rates of every axis, given the faces of the cluster's box as seen from the VPL.
template <class Change>
Shaft changed(const ClusterRecord& c, Vec3 apex, float sigma, const Change& change) {
    Shaft s = mir::make_shaft(c, apex, sigma);
    for (int k = 0; k < 3; ++k) {
        mir::detail::ShaftRates rates{s.rises[k], s.falls[k], s.leaves[k]};
        change(rates, c.low[k] - apex[k], c.high[k] - apex[k]);
        s.rises[k] = rates.rises;
        s.falls[k] = rates.falls;
        s.leaves[k] = rates.leaves;
    }
    return s;
}

Shaft sign_of_difference(const ClusterRecord& c, Vec3 apex, float sigma) {
    return changed(c, apex, sigma, [](mir::detail::ShaftRates& r, float low, float high) {
        r.falls = std::copysign(r.falls, low);
        r.rises = std::copysign(r.rises, high);
    });
}

Shaft touching_face_is_beside(const ClusterRecord& c, Vec3 apex, float sigma) {
    return changed(c, apex, sigma, [](mir::detail::ShaftRates& r, float low, float) {
        if (low == 0.0f) r = {r.rises, 0.0f, 1e18f};
    });
}

Shaft wrong_sign(const ClusterRecord& c, Vec3 apex, float sigma) {
    return changed(c, apex, sigma,
                   [](mir::detail::ShaftRates& r, float, float) { r.leaves = -r.leaves; });
}

Shaft straddling_axis_ends(const ClusterRecord& c, Vec3 apex, float sigma) {
    return changed(c, apex, sigma, [](mir::detail::ShaftRates& r, float, float) {
        if (r.leaves == 0.0f) r.leaves = r.rises;
    });
}

Shaft without_falls(const ClusterRecord& c, Vec3 apex, float sigma) {
    return changed(c, apex, sigma,
                   [](mir::detail::ShaftRates& r, float, float) { r.falls = 0.0f; });
}

Shaft meets_everything(const ClusterRecord&, Vec3, float) { return {}; }

/// Cluster [1, 2] x [-1, 1] x [0, 0] metres.
ClusterRecord flat_cluster() {
    ClusterRecord c;
    c.low = {1, -1, 0};
    c.high = {2, 1, 0};
    c.luxels = 1;
    return c;
}

}  // namespace

TEST_CASE("No shaft refuses a box that one of its segments meets") {
    const Wrong wrong = refusals(mir::make_shaft, 1000000);
    CHECK(wrong.met > 900000);
    CHECK(wrong.refused == 0);
}

TEST_CASE("Shafts without slack or with a wrong sign refuse boxes that are met") {
    CHECK(refusals<NoSlack>(mir::make_shaft, 200000).refused > 1000);
    CHECK(refusals(sign_of_difference, 200000).refused > 1000);
    CHECK(refusals(touching_face_is_beside, 200000).refused > 100);
    CHECK(refusals(wrong_sign, 200000).refused > 1000);
    CHECK(refusals(straddling_axis_ends, 200000).refused > 1000);
}

TEST_CASE("Shafts refuse every box that they miss by a thousandth of the way") {
    CHECK(loosely_accepted(mir::make_shaft, 1000000) == 0);
    CHECK(loosely_accepted(without_falls, 200000) > 1000);
    CHECK(loosely_accepted(meets_everything, 200000) > 1000);
}

TEST_CASE("Rates are finite and signed by where the VPL lies, also at a face") {
    mir::Random random = mirtest::test_random(3);
    for (int i = 0; i < 100000; ++i) {
        const float scale = std::pow(10.0f, 6.0f * random.next() - 3.0f);
        const ShaftDraw d = mirtest::draw_shaft(random, scale);
        const Shaft s = mir::make_shaft(d.cluster, d.apex, mirtest::float_sigma(scale));
        REQUIRE((mir::is_finite(s.rises) && mir::is_finite(s.falls) && mir::is_finite(s.leaves)));
        for (int k = 0; k < 3; ++k) {
            REQUIRE((s.rises[k] >= 0.0f && s.falls[k] <= 0.0f));
            REQUIRE((s.leaves[k] > 0.0f) == (d.cluster.low[k] > d.apex[k]));
            REQUIRE((s.leaves[k] < 0.0f) == (d.cluster.high[k] < d.apex[k]));
        }
    }
}

TEST_CASE("A VPL on a face, edge or corner of the cluster's box meets boxes around itself") {
    const ClusterRecord c = flat_cluster();
    for (const Vec3 apex : {Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(1, -1, 0), Vec3(2, 1, 0),
                            Vec3(1.5f, 0, 0), Vec3(1, -1, -0.0f), Vec3(1, 0, 1), Vec3(0, 0, 0)}) {
        const Shaft s = mir::make_shaft(c, apex, 0.0f);
        CHECK(mir::meets_box(s, apex, apex));
        CHECK(mir::meets_box(s, c.low, c.low));
        CHECK(mir::meets_box(s, c.high, c.high));
        CHECK_FALSE(mir::meets_box(s, {1, -1, 1.5f}, {2, 1, 2}));
        CHECK_FALSE(mir::meets_box(s, {2.25f, -1, -1}, {3, 1, 1}));
    }
}

TEST_CASE("Segments in an axis's plane meet flat boxes in that plane and no others") {
    const Shaft s = mir::make_shaft(flat_cluster(), {0, 0, 0}, 0.0f);
    CHECK(mir::meets_box(s, {0.5f, -0.1f, 0}, {0.5f, 0.1f, 0}));
    CHECK(mir::meets_box(s, {0.5f, 0, -1}, {0.5f, 0, 0}));
    CHECK_FALSE(mir::meets_box(s, {0.5f, 0, 1e-3f}, {0.5f, 0, 1}));
    CHECK_FALSE(mir::meets_box(s, {0.5f, 0, -1}, {0.5f, 0, -1e-3f}));
}

TEST_CASE("A luxel at the VPL makes a shaft that meets boxes around it alone") {
    ClusterRecord c;
    c.low = c.high = {1, 2, 3};
    c.luxels = 1;
    const Shaft s = mir::make_shaft(c, c.low, 0.0f);
    CHECK(mir::meets_box(s, {1, 2, 3}, {1, 2, 3}));
    CHECK(mir::meets_box(s, {0, 0, 0}, {4, 4, 4}));
    CHECK_FALSE(mir::meets_box(s, {1, 2, 3.5f}, {1, 2, 4}));
    CHECK_FALSE(mir::meets_box(s, {0, 2, 3}, {0.5f, 2, 3}));
}
