// SPDX-License-Identifier: MIT
#include "mir/shaft/exact/shaft.hpp"
#include "shaft/cluster_draws.hpp"
#include "support/catch.hpp"
#include "support/soa_run.hpp"

// What a shaft's half-space refuses must lie behind the VPL and behind every luxel, as judged in
// long arithmetic. VPLs are put next to the plane, boxes next to the VPL.

namespace {

using mir::AffineRow;
using mir::ClusterRecord;
using mir::Hit;
using mir::Vec3;

using FrontOf = AffineRow (*)(const ClusterRecord&, Vec3, float);

long double along(AffineRow row, Vec3 p) {
    return static_cast<long double>(row.x) * p.x + static_cast<long double>(row.y) * p.y +
           static_cast<long double>(row.z) * p.z;
}

/// Luxels of a cluster; a half-space along any direction at all holds them as well.
struct Cluster {
    std::vector<Hit> hits;
    ClusterRecord record;
};

Cluster random_cluster(mir::Random& random, float scale) {
    Cluster c;
    const bool flat = mirtest::chance(random, 0.5f);
    const bool opposed = mirtest::chance(random, 0.3f);
    const Vec3 n = mirtest::direction(random);
    const Vec3 middle = 0.7f * mirtest::point_in_cube(random);
    const float size = 0.3f * std::pow(10.0f, -4.0f * random.next());
    for (int i = 0; i < 8; ++i) {
        Vec3 p = size * mirtest::point_in_cube(random);
        if (flat) p -= glm::dot(p, n) * n;
        c.hits.push_back({scale * (middle + p), opposed && i % 2 == 0 ? -n : n});
    }
    c.record =
        mir::cluster_record(mirtest::HitRun(c.hits).view(), 0, 8, mirtest::float_sigma(scale));
    return c;
}

/// In most draws within rounding of the half-space's plane.
Vec3 vpl_near_plane(mir::Random& random, AffineRow front, float scale) {
    const Vec3 anywhere = scale * mirtest::point_in_cube(random);
    if (mirtest::chance(random, 0.2f)) return anywhere;
    const Vec3 n(front.x, front.y, front.z);
    const float aside = 0x1p-23f * scale * (2.0f * random.next() - 1.0f);
    return anywhere - (mir::row_at(front, anywhere) + aside) * n;
}

struct Wrong {
    std::size_t refused = 0;
    std::size_t met = 0;  ///< refused although a segment's end is not behind the box
};

/// Of small boxes around points of segments.
Wrong refusals(FrontOf front_of, int draws) {
    Wrong wrong;
    mir::Random random = mirtest::test_random(4);
    for (int i = 0; i < draws; ++i) {
        const float scale = std::pow(10.0f, static_cast<float>(i % 3 - 1) * 3.0f);
        const Cluster c = random_cluster(random, scale);
        const Vec3 q = vpl_near_plane(random, c.record.front, scale);
        const AffineRow front = front_of(c.record, q, mirtest::float_sigma(scale));
        const Vec3 p = c.hits[static_cast<std::size_t>(i) % 8].position;
        const float aside = std::exp2(
            mirtest::chance(random, 0.5f) ? -24.0f - random.next() : -4.0f - 16.0f * random.next());
        const Vec3 x =
            q + 1e-4f * random.next() * (p - q) + aside * scale * mirtest::point_in_cube(random);
        const Vec3 size = 0x1p-25f * scale * Vec3(random.next());
        if (mir::detail::in_front(front, x - size, x + size)) continue;
        ++wrong.refused;
        long double least = along(front, q);
        for (const Hit& h : c.hits) least = std::min(least, along(front, h.position));
        const Vec3 foremost(front.x > 0 ? x.x + size.x : x.x - size.x,
                            front.y > 0 ? x.y + size.y : x.y - size.y,
                            front.z > 0 ? x.z + size.z : x.z - size.z);
        if (along(front, foremost) >= least) ++wrong.met;
    }
    return wrong;
}

AffineRow without_slack(const ClusterRecord& c, Vec3 apex, float) {
    return mir::detail::front_of(c, apex, 0.0f);
}

AffineRow other_side(const ClusterRecord& c, Vec3 apex, float sigma) {
    const AffineRow front = mir::detail::front_of(c, apex, sigma);
    return {-front.x, -front.y, -front.z, -front.w};
}

AffineRow vpl_not_asked(const ClusterRecord& c, Vec3, float sigma) {
    AffineRow front = c.front;
    front.w += 2.0f * sigma;
    return front;
}

}  // namespace

TEST_CASE("Boxes refused by a half-space lie behind the VPL and behind all luxels") {
    const Wrong wrong = refusals(mir::detail::front_of, 1000000);
    CHECK(wrong.refused > 1000);
    CHECK(wrong.met == 0);
}

TEST_CASE("Half-spaces without slack, turned round or for any VPL refuse boxes that are met",
          "[slow]") {
    CHECK(refusals(without_slack, 1000000).met > 100);
    CHECK(refusals(other_side, 200000).met > 1000);
    CHECK(refusals(vpl_not_asked, 200000).met > 1000);
}

TEST_CASE("A half-space spares the floor that its cluster stands on from the cluster's list") {
    const std::vector<Hit> hits{{{0, 0, 0.01f}, {0, 0, 1}}, {{1, 1, 0.01f}, {0, 0, 1}}};
    const float sigma = mirtest::float_sigma(1.0f);
    const ClusterRecord c = mir::cluster_record(mirtest::HitRun(hits).view(), 0, 2, sigma);
    const mir::Shaft from_above = mir::make_shaft(c, {0.5f, 0.5f, 1}, sigma);
    CHECK_FALSE(mir::meets_box(from_above, {0, 0, 0}, {1, 1, 0}));
    CHECK(mir::meets_box(from_above, {0, 0, 0}, {1, 1, 0.02f}));
    const mir::Shaft from_below = mir::make_shaft(c, {0.5f, 0.5f, -1}, sigma);
    CHECK(mir::meets_box(from_below, {0, 0, 0}, {1, 1, 0}));
}

TEST_CASE("A VPL on the plane of a half-space keeps it, one behind it gives it up") {
    ClusterRecord c;
    c.front = {0, 0, 1, -0.5f};
    CHECK(mir::detail::front_of(c, {3, 4, 0.5f}, 0.0f).z == 1.0f);
    CHECK(mir::detail::front_of(c, {3, 4, 0.25f}, 0.0f).z == 0.0f);
}
