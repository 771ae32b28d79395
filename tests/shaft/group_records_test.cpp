// SPDX-License-Identifier: MIT
#include "mir/shaft/device/group_records.hpp"

#include "shaft/cluster_draws.hpp"
#include "support/catch.hpp"
#include "support/soa_run.hpp"

#include <cmath>
#include <limits>
#include <vector>

// The records of groups against those that are made one luxel after the other.

namespace {

using mir::ClusterRecord;
using mir::Hit;
using mir::Vec3;

constexpr float sigma = 0x1p-19f;

/// Blocks of luxels on slopes, every fifth of them empty and every 50th no number.
std::vector<Hit> luxels_on_slopes(std::uint32_t count) {
    mir::Random random = mirtest::test_random(21);
    std::vector<Hit> hits;
    while (hits.size() < count) {
        const Hit middle{0.8f * mirtest::point_in_cube(random), mirtest::direction(random)};
        for (std::uint32_t k = 0; k < mir::cluster_luxels; ++k) {
            Hit hit = mirtest::hit_beside(middle, 0.01f, random);
            if (k % 5 == 4) hit = {Vec3(9), Vec3(0)};
            if (hits.size() % 50 == 49) hit.position.y = std::numeric_limits<float>::quiet_NaN();
            hits.push_back(hit);
        }
    }
    return hits;
}

/// The same box, and half-spaces that differ by rounding of the normals' sum.
bool alike(const ClusterRecord& a, const ClusterRecord& b) {
    const Vec3 turned(a.front.x - b.front.x, a.front.y - b.front.y, a.front.z - b.front.z);
    return a.low == b.low && a.high == b.high && a.luxels == b.luxels &&
           mir::max_abs(turned) < 1e-5f && a.tilt.axis == b.tilt.axis &&
           std::fabs((a.tilt.high - a.tilt.low) - (b.tilt.high - b.tilt.low)) < sigma;
}

}  // namespace

TEST_CASE("Groups make the records of all blocks and clusters") {
    const std::uint32_t count = 4 * mir::block_luxels;
    std::vector<Hit> hits = luxels_on_slopes(count);
    std::vector<ClusterRecord> blocks(4);
    std::vector<ClusterRecord> clusters(32);
    const mirtest::HitRun run(hits);
    const mir::GroupRecords kernel{run.view(), sigma, blocks.data(), clusters.data()};
    mir::GroupRecords::Workspace space;
    for (std::uint32_t i = 0; i < mir::GroupRecords::groups(count); ++i)
        kernel(mir::LaneGroup{}, i, space);
    // Luxels that are no number are left out by groups wherever they come.
    for (Hit& hit : hits)
        if (!(std::fabs(hit.position.y) >= 0.0f)) hit.normal = Vec3(0);
    const mirtest::HitRun numbers(hits);
    std::size_t leaning = 0;
    for (std::uint32_t k = 0; k < 32; ++k) {
        INFO("cluster " << k);
        CHECK(alike(clusters[k], mir::cluster_record(numbers.view(), 32 * k, 32, sigma)));
        leaning += clusters[k].tilt.axis != mir::TiltedAxis::none ? 1 : 0;
    }
    CHECK(leaning > 16);
    for (std::uint32_t k = 0; k < 4; ++k)
        CHECK(alike(blocks[k], mir::cluster_record(numbers.view(), 256 * k, 256, sigma)));
}
