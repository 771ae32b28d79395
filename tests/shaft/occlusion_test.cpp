// SPDX-License-Identifier: MIT
#include "mir/shaft/exact/occlusion.hpp"

#include "shaft/occlusion_draws.hpp"
#include "support/catch.hpp"

// What is said of a triangle and a pyramid is judged by hits_segment() itself, at the corners of
// the box and inside it.

namespace {

using mir::Occlusion;
using mir::TriangleRows;
using mir::Vec3;
using Draw = mirtest::OcclusionDraw;

struct Wrong {
    std::size_t none = 0;
    std::size_t full = 0;
    std::size_t wrongly_none = 0;  ///< although some segment is hit
    std::size_t wrongly_full = 0;  ///< although some segment is not
};

struct Hits {
    std::size_t some = 0;
    std::size_t asked = 0;
};

Hits count_hits(mir::Random& random, const Draw& d) {
    Hits hits;
    const auto ask = [&](Vec3 p) {
        ++hits.asked;
        if (mir::hits_segment(d.rows, p, d.apex)) ++hits.some;
    };
    const bool leans = d.cluster.tilt.axis != mir::TiltedAxis::none;
    for (std::uint32_t k = 0; k < 8 && !leans; ++k)
        ask({(k & 1u) != 0 ? d.cluster.high.x : d.cluster.low.x,
             (k & 2u) != 0 ? d.cluster.high.y : d.cluster.low.y,
             (k & 4u) != 0 ? d.cluster.high.z : d.cluster.low.z});
    for (int k = 0; k < (leans ? 16 : 8); ++k)
        ask(mirtest::random_leaning_luxel(random, d.cluster));
    return hits;
}

using Classify = Occlusion (*)(const TriangleRows&, const mir::Pyramid&);

/// Of draws at three scales.
Wrong wrong_answers(Classify classify, int draws, bool lean = false) {
    Wrong wrong;
    mir::Random random = mirtest::test_random(5);
    for (int i = 0; i < draws; ++i) {
        const float scale = std::pow(10.0f, static_cast<float>(i % 3 - 1) * 3.0f);
        const Draw d =
            lean ? mirtest::leaning_draw(random, scale) : mirtest::occlusion_draw(random, scale);
        const mir::Pyramid pyramid =
            mir::make_pyramid(d.cluster, d.apex, mirtest::float_sigma(scale));
        const Occlusion found = classify(d.rows, pyramid);
        if (found == Occlusion::partial) continue;
        const Hits hits = count_hits(random, d);
        if (found == Occlusion::none) {
            ++wrong.none;
            if (hits.some > 0) ++wrong.wrongly_none;
        } else {
            ++wrong.full;
            if (hits.some < hits.asked) ++wrong.wrongly_full;
        }
    }
    return wrong;
}

struct NoMargins {
    static constexpr float plane = 0.0f;
    static constexpr float edge = 0.0f;
    static constexpr float hit_share = 1.0f;
};

/// The third edge four times as far from the first corner as it is.
Occlusion third_edge_far_off(const TriangleRows& rows, const mir::Pyramid& p) {
    TriangleRows wide = rows;
    for (mir::AffineRow* row : {&wide.u, &wide.v})
        *row = {0.25f * row->x, 0.25f * row->y, 0.25f * row->z, 0.25f * row->w};
    return mir::occlusion(wide, p);
}

/// The box grown by sigma in place of margins.
Occlusion padding_alone(const TriangleRows& rows, const mir::Pyramid& p) {
    mir::Pyramid grown = p;
    grown.half += p.sigma;
    return mir::occlusion<NoMargins>(rows, grown);
}

Occlusion plane_turned_round(const TriangleRows& rows, const mir::Pyramid& p) {
    mir::Pyramid mirrored = p;
    mirrored.centre = 2.0f * p.apex - p.centre;
    return mir::occlusion(rows, mirrored);
}

Occlusion centre_alone(const TriangleRows& rows, const mir::Pyramid& p) {
    mir::Pyramid point = p;
    point.half = Vec3(0);
    return mir::occlusion(rows, point);
}

/// The box as thin as if it leaned, but upright.
Occlusion thin_and_upright(const TriangleRows& rows, const mir::Pyramid& p) {
    mir::Pyramid upright = p;
    upright.slope = Vec3(0);
    return mir::occlusion(rows, upright);
}

/// The plane sloping the other way.
Occlusion slope_turned_round(const TriangleRows& rows, const mir::Pyramid& p) {
    mir::Pyramid turned = p;
    turned.slope = -p.slope;
    return mir::occlusion(rows, turned);
}

}  // namespace

TEST_CASE("Triangles that miss or cover a pyramid hit none or all of its segments") {
    const Wrong wrong = wrong_answers(mir::occlusion<>, 1000000, GENERATE(false, true));
    INFO(wrong.none << " none, " << wrong.full << " full");
    CHECK(wrong.none > 10000);
    CHECK(wrong.full > 10000);
    CHECK(wrong.wrongly_none == 0);
    CHECK(wrong.wrongly_full == 0);
}

TEST_CASE("Pyramid tests without margins or with a wrong sign give wrong answers") {
    const Wrong no_margins = wrong_answers(mir::occlusion<NoMargins>, 200000);
    CHECK(no_margins.wrongly_none > 100);
    CHECK(no_margins.wrongly_full > 10);
    CHECK(wrong_answers(padding_alone, 1000000).wrongly_none > 10);
    CHECK(wrong_answers(third_edge_far_off, 200000).wrongly_full > 100);
    CHECK(wrong_answers(plane_turned_round, 200000).wrongly_none > 100);
    CHECK(wrong_answers(centre_alone, 200000).wrongly_full > 100);
}

TEST_CASE("Boxes that lean the wrong way or not at all give wrong answers") {
    CHECK(wrong_answers(thin_and_upright, 200000, true).wrongly_none > 100);
    CHECK(wrong_answers(slope_turned_round, 200000, true).wrongly_none > 100);
}
