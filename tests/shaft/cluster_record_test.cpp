// SPDX-License-Identifier: MIT
#include "mir/shaft/exact/cluster_record.hpp"

#include "conformance/worlds.hpp"
#include "mir/accel/exact/accept_box.hpp"
#include "support/catch.hpp"
#include "support/soa_run.hpp"

namespace {

using mir::ClusterRecord;
using mir::Hit;
using mir::Vec3;

constexpr float sigma = 0x1p-19f;

ClusterRecord record_of(const std::vector<Hit>& hits) {
    const mirtest::HitRun run(hits);
    return mir::cluster_record(run.view(), 0, run.size(), sigma);
}

/// Every fourth luxel is empty and lies far away.
std::vector<Hit> random_luxels(std::uint32_t count, mir::Random& random, float scale) {
    std::vector<Hit> hits;
    const Vec3 middle = 0.8f * mirtest::point_in_cube(random);
    const float size = 0.2f * random.next();
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 p = middle + size * mirtest::point_in_cube(random);
        if (i % 4 == 3)
            hits.push_back({scale * Vec3(100, 100, 100), {0, 0, 0}});
        else
            hits.push_back({scale * p, mirtest::direction(random)});
    }
    return hits;
}

long double row_exactly(mir::AffineRow row, Vec3 p) {
    return static_cast<long double>(row.x) * p.x + static_cast<long double>(row.y) * p.y +
           static_cast<long double>(row.z) * p.z + row.w;
}

}  // namespace

TEST_CASE("A cluster's box and half-space hold its luxels and no empty ones") {
    const float scale = GENERATE(1e-3f, 1.0f, 1e3f);
    const float own_sigma = scale * sigma;
    mir::Random random = mirtest::test_random(1);
    for (int i = 0; i < 2000; ++i) {
        const std::vector<Hit> hits = random_luxels(32, random, scale);
        const mirtest::HitRun run(hits);
        const ClusterRecord r = mir::cluster_record(run.view(), 0, 32, own_sigma);
        mir::Bounds box;
        for (const Hit& h : hits) {
            if (is_empty(h)) continue;
            box.add(h.position);
            REQUIRE(row_exactly(r.front, h.position) > 1.5L * own_sigma);
        }
        CHECK(r.luxels == 24);
        CHECK(glm::all(glm::lessThanEqual(r.low, box.low - 0.9f * own_sigma)));
        CHECK(glm::all(glm::greaterThanEqual(r.high, box.high + 0.9f * own_sigma)));
        CHECK(mir::max_abs(r.low - box.low) < 1.1f * own_sigma);
        CHECK(mir::max_abs(r.high - box.high) < 1.1f * own_sigma);
    }
}

TEST_CASE("A flat cluster's half-space touches it") {
    const ClusterRecord r = record_of({{{0, 0, 0.5f}, {0, 0, 1}}, {{1, 1, 0.5f}, {0, 0, 1}}});
    CHECK(Vec3(r.front.x, r.front.y, r.front.z) == Vec3(0, 0, 1));
    CHECK(r.front.w == 2.0f * sigma - 0.5f);
}

TEST_CASE("A cluster of one luxel and one whose luxels coincide are points grown by sigma") {
    const Hit hit{{0.25f, 0.5f, -0.75f}, {0, 1, 0}};
    for (const auto& hits : {std::vector<Hit>{hit}, std::vector<Hit>(32, hit)}) {
        const ClusterRecord r = record_of(hits);
        CHECK(r.low == hit.position - sigma);
        CHECK(r.high == hit.position + sigma);
        CHECK(r.luxels == hits.size());
    }
}

TEST_CASE("A cluster without luxels is empty whatever its padding holds") {
    const ClusterRecord r = record_of(std::vector<Hit>(32, Hit{{1, 2, 3}, {0, 0, 0}}));
    CHECK(r.luxels == 0);
    CHECK(record_of({}).luxels == 0);
}

TEST_CASE("Normals that cancel leave a half-space that is the whole space") {
    const ClusterRecord r = record_of({{{0, 0, 1}, {0, 0, 1}}, {{0, 0, 0}, {0, 0, -1}}});
    CHECK(Vec3(r.front.x, r.front.y, r.front.z) == Vec3(0));
    CHECK(r.front.w > 0.0f);
}

TEST_CASE("The kernel makes a record of each run") {
    mir::Random random = mirtest::test_random(2);
    const std::vector<Hit> hits = random_luxels(96, random, 1.0f);
    const mirtest::HitRun run(hits);
    std::vector<ClusterRecord> records(3);
    const mir::ClusterRecords kernel{run.view(), 32, sigma, records.data()};
    for (std::uint32_t i = 0; i < 3; ++i) kernel(i);
    for (std::uint32_t i = 0; i < 3; ++i) {
        const ClusterRecord alone = record_of({hits.begin() + 32 * i, hits.begin() + 32 * (i + 1)});
        CHECK(records[i].low == alone.low);
        CHECK(records[i].high == alone.high);
        CHECK(records[i].front.w == alone.front.w);
        CHECK(records[i].luxels == alone.luxels);
    }
}

TEST_CASE("A cluster is within reach when its whole box is") {
    const ClusterRecord r = record_of({{{0, 1, 0}, {0, 1, 0}}, {{0, -2, 0}, {0, 1, 0}}});
    CHECK(mir::within_reach(r, 2.1f));
    CHECK_FALSE(mir::within_reach(r, 1.9f));
}

TEST_CASE("The leaning box of a cluster on a slope holds its luxels and is thin") {
    const float scale = GENERATE(1e-3f, 1.0f, 1e3f);
    const float own_sigma = scale * sigma;
    mir::Random random = mirtest::test_random(3);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 normal = mirtest::direction(random);
        const Vec3 middle = 0.8f * mirtest::point_in_cube(random);
        std::vector<Hit> hits;
        for (int k = 0; k < 32; ++k)
            hits.push_back(mirtest::hit_beside({scale * middle, normal}, 0.01f * scale, random));
        const mirtest::HitRun run(hits);
        const ClusterRecord r = mir::cluster_record(run.view(), 0, 32, own_sigma);
        if (r.tilt.axis == mir::TiltedAxis::none) continue;  // flat along an axis as it is
        for (const Hit& h : hits) {
            REQUIRE(r.tilt.along(h.position) >= r.tilt.low + own_sigma);
            REQUIRE(r.tilt.along(h.position) <= r.tilt.high - own_sigma);
        }
        CHECK(r.tilt.high - r.tilt.low < 6.0f * own_sigma);
    }
}

TEST_CASE("Boxes lean only where that makes them thinner, and none as large as the scene") {
    const auto leans = [](const std::vector<Hit>& hits) {
        return record_of(hits).tilt.axis != mir::TiltedAxis::none;
    };
    const Vec3 sloping = glm::normalize(Vec3(1, 0, 1));
    CHECK(leans({{{0, 0, 0}, sloping}, {{0.01f, 0.01f, -0.01f}, sloping}}));
    CHECK_FALSE(leans({{{0, 0, 0}, sloping}, {{0.2f, 0.2f, -0.2f}, sloping}}));
    CHECK_FALSE(leans({{{0, 0, 0}, sloping}, {{0.01f, 0.01f, 0.01f}, sloping}}));
    CHECK_FALSE(leans({{{0, 0, 0}, {0, 0, 1}}, {{0.01f, 0.01f, 0}, {0, 0, 1}}}));
    CHECK_FALSE(leans({{{0, 0, 0}, sloping}, {{0.01f, 0, -0.01f}, -sloping}}));
}
