// SPDX-License-Identifier: MIT
#include "mir/shaft/host/block_records.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"
#include "support/soa_run.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace {

using mir::BlockRecords;
using mir::ClusterRecord;
using mir::Hit;
using mir::Vec3;

constexpr float sigma = 1e-6f;
constexpr float reach = 100.0f;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// A block of a bent surface, of which a part is empty.
std::vector<Hit> bent_surface(std::uint32_t seed, float empty) {
    mir::Random random = mirtest::test_random(seed);
    std::vector<Hit> hits(mir::BlockMask::luxels);
    for (Hit& hit : hits) {
        const float x = random.next();
        const float y = random.next();
        hit.position = {x, y, 0.2f * x * x - 0.1f * y};
        hit.normal =
            random.next() < empty ? Vec3(0.0f) : glm::normalize(Vec3(-0.4f * x, 0.1f, 1.0f));
    }
    return hits;
}

/// Compares a record with that of the same luxels, found one after the other.
void check_record(const BlockRecords::Cluster& found, const std::vector<Hit>& hits,
                  std::uint32_t first, std::uint32_t count) {
    const mirtest::HitRun run(hits);
    const ClusterRecord wanted = mir::cluster_record(run.view(), first, count, sigma);
    CHECK(found.record.luxels == wanted.luxels);
    CHECK(found.within == (wanted.luxels != 0));
    if (wanted.luxels == 0) return;
    CHECK(found.record.low == wanted.low);
    CHECK(found.record.high == wanted.high);
    CHECK(found.record.tilt.axis == mir::TiltedAxis::none);
    // Sums of normals are rounded in another order.
    CHECK(glm::length(Vec3(found.record.front.x, found.record.front.y, found.record.front.z) -
                      Vec3(wanted.front.x, wanted.front.y, wanted.front.z)) < 1e-5f);
    float least = infinity;
    for (std::uint32_t i = first; i < first + count; ++i)
        if (!is_empty(hits[i]))
            least = std::min(least, row_at(found.record.front, hits[i].position));
    CHECK(least == Approx(2.0f * sigma).margin(0.5f * sigma));
    CHECK(found.box.centre == 0.5f * (found.record.low + found.record.high));
}

void check_all(const BlockRecords& block, const std::vector<Hit>& hits) {
    for (std::uint32_t g = 0; g < BlockRecords::packets; ++g) {
        check_record(block.packet[g], hits, 16 * g, 16);
        for (std::uint32_t k = 0; k < 16; ++k) {
            CHECK(block.points[g].x[k] == hits[16 * g + k].position.x);
            CHECK(block.points[g].y[k] == hits[16 * g + k].position.y);
            CHECK(block.points[g].z[k] == hits[16 * g + k].position.z);
        }
    }
    for (std::uint32_t g = 0; g < BlockRecords::packets / 2; ++g)
        check_record(block.pair[g], hits, 32 * g, 32);
    check_record(block.all, hits, 0, 256);
}

}  // namespace

TEST_CASE("Records of a block are those of its clusters, one by one") {
    std::uint32_t seed = 0;
    for (const float empty : {0.0f, 0.3f, 0.95f, 2.0f}) {
        const std::vector<Hit> hits = bent_surface(++seed, empty);
        check_all(BlockRecords(mirtest::HitRun(hits).view(), reach, sigma), hits);
    }
}

TEST_CASE("Records of a block are within reach where all of its luxels are") {
    for (const float odd : {infinity, -infinity, 101.0f}) {
        std::vector<Hit> hits = bent_surface(7, 0.0f);
        hits[5 * 16 + 3].position.y = odd;
        const BlockRecords block(mirtest::HitRun(hits).view(), reach, sigma);
        for (std::uint32_t g = 0; g < BlockRecords::packets; ++g)
            CHECK(block.packet[g].within == (g != 5));
        for (std::uint32_t g = 0; g < BlockRecords::packets / 2; ++g)
            CHECK(block.pair[g].within == (g != 2));
        CHECK_FALSE(block.all.within);
    }
}

TEST_CASE("Luxels that are no number are left out of the boxes of their clusters") {
    for (const std::uint32_t place : {0u, 16u, 40u}) {
        std::vector<Hit> hits = bent_surface(8, 0.0f);
        hits[place].position.x = none;
        const BlockRecords block(mirtest::HitRun(hits).view(), reach, sigma);
        CHECK(block.all.within);
        CHECK(std::isfinite(block.all.record.low.x));
        CHECK(std::isfinite(block.packet[place / 16].record.front.w));
    }
    std::vector<Hit> hits = bent_surface(9, 0.0f);
    for (std::uint32_t k = 0; k < 16; ++k) hits[k].position = Vec3(none);
    const BlockRecords block(mirtest::HitRun(hits).view(), reach, sigma);
    CHECK_FALSE(block.packet[0].within);
    CHECK(block.packet[1].within);
}
