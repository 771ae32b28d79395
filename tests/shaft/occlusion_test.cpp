// SPDX-License-Identifier: MIT
#include "mir/shaft/occlusion.hpp"

#include "shaft/cluster_draws.hpp"
#include "support/catch.hpp"

// What is said of a triangle and a pyramid is judged by hits_segment() itself, at the corners of
// the box and inside it.

namespace {

using mir::ClusterRecord;
using mir::Occlusion;
using mir::TriangleRows;
using mir::Vec3;

/// A triangle, a VPL and a box; a segment between the last two passes next to an edge.
struct Draw {
    TriangleRows rows;
    ClusterRecord cluster;
    Vec3 apex{0};
};

/// From regular to needles of aspect 10^6.
std::array<Vec3, 3> random_triangle(mir::Random& random) {
    const Vec3 a = 0.8f * mirtest::point_in_cube(random);
    const float size = 0.5f * std::pow(10.0f, -3.0f * random.next());
    const float thin =
        mirtest::chance(random, 0.5f) ? 1.0f : std::pow(10.0f, -6.0f * random.next());
    const Vec3 along = size * mirtest::direction(random);
    const Vec3 apex = a + random.next() * along + thin * size * mirtest::direction(random);
    return {a, a + along, apex};
}

/// Behind the target, at times next to it, and never far outside of the scene.
Vec3 beyond(mir::Random& random, Vec3 apex, Vec3 target) {
    const float share =
        mirtest::chance(random, 0.2f) ? 1.0f + 1e-3f * random.next() : 1.0f + 1.5f * random.next();
    const Vec3 p = apex + share * (target - apex);
    return mir::max_abs(p) < 1.0f ? p : apex + 1.01f * (target - apex);
}

/// The box has the point as a corner, or around itself.
ClusterRecord box_at(mir::Random& random, Vec3 p) {
    const float size = 0.2f * std::pow(10.0f, -7.0f * random.next());
    ClusterRecord c;
    c.luxels = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const float below = mirtest::chance(random, 0.6f) ? 0.0f : size * random.next();
        const float above = mirtest::chance(random, 0.6f) ? 0.0f : size * random.next();
        c.low[axis] = p[axis] - below;
        c.high[axis] = p[axis] + above;
    }
    return c;
}

/// All that is drawn lies within 1.5 times `scale`, the largest coordinate of the scene.
Draw draw(mir::Random& random, float scale) {
    const std::array<Vec3, 3> t = random_triangle(random);
    Draw d;
    d.rows = mir::make_triangle_rows(scale * t[0], scale * t[1], scale * t[2]);
    const float share = 1.2f * random.next() - 0.1f;
    const std::uint32_t k = random.next() < 0.5f ? 0 : 1;
    const float aside = (mirtest::chance(random, 0.3f) ? -1.0f : 1.0f) *
                        std::pow(10.0f, -8.0f * random.next() - 0.5f);
    const Vec3 edge = (1.0f - share) * t[k] + share * t[k + 1];
    const Vec3 target = edge + aside * (t[2 - 2 * k] - edge);
    Vec3 apex = mirtest::point_in_cube(random);
    if (mirtest::chance(random, 0.2f)) {  // almost in the plane of the triangle
        const float u = 2.0f * random.next() - 1.0f;
        apex = t[0] + u * (t[1] - t[0]) + 0.5f * (t[2] - t[0]) + 1e-4f * random.next() * apex;
    }
    if (mir::max_abs(apex) > 1.0f) apex /= mir::max_abs(apex);
    d.apex = scale * apex;
    d.cluster = box_at(random, beyond(random, apex, target));
    d.cluster.low *= scale;
    d.cluster.high *= scale;
    return d;
}

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
    for (std::uint32_t k = 0; k < 8; ++k)
        ask({(k & 1u) != 0 ? d.cluster.high.x : d.cluster.low.x,
             (k & 2u) != 0 ? d.cluster.high.y : d.cluster.low.y,
             (k & 4u) != 0 ? d.cluster.high.z : d.cluster.low.z});
    for (int k = 0; k < 8; ++k) ask(mirtest::random_luxel(random, d.cluster));
    return hits;
}

using Classify = Occlusion (*)(const TriangleRows&, const mir::Pyramid&);

/// Of draws at three scales.
Wrong wrong_answers(Classify classify, int draws) {
    Wrong wrong;
    mir::Random random = mirtest::test_random(5);
    for (int i = 0; i < draws; ++i) {
        const float scale = std::pow(10.0f, static_cast<float>(i % 3 - 1) * 3.0f);
        const Draw d = draw(random, scale);
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

}  // namespace

TEST_CASE("Triangles that miss or cover a pyramid hit none or all of its segments") {
    const Wrong wrong = wrong_answers(mir::occlusion<>, 1000000);
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
