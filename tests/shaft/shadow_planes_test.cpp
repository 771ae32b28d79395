// SPDX-License-Identifier: MIT
#include "mir/shaft/exact/shadow_planes.hpp"

#include "shaft/occlusion_draws.hpp"
#include "support/catch.hpp"

// What planes say of single segments is judged by hits_segment() itself.

namespace {

using mir::ShadowPlanes;
using mir::Vec3;

struct Answers {
    std::size_t asked = 0;
    std::size_t hit = 0;     ///< surely
    std::size_t missed = 0;  ///< surely
    std::size_t wrong_hits = 0;
    std::size_t wrong_misses = 0;
};

/// Of draws at three scales, of triangles that are partial. `share` of the margins is kept.
Answers answers(int draws, float share, bool lean = false) {
    Answers answers;
    mir::Random random = mirtest::test_random(15);
    for (int i = 0; i < draws; ++i) {
        const float scale = std::pow(10.0f, static_cast<float>(i % 3 - 1) * 3.0f);
        const mirtest::OcclusionDraw d =
            lean ? mirtest::leaning_draw(random, scale) : mirtest::occlusion_draw(random, scale);
        const float sigma = mirtest::float_sigma(scale);
        const mir::Pyramid pyramid = mir::make_pyramid(d.cluster, d.apex, sigma);
        ShadowPlanes planes;
        if (occlusion(d.rows, pyramid, planes) != mir::Occlusion::partial) continue;
        planes.margins = {share * planes.margins.u, share * planes.margins.v,
                          share * planes.margins.w};
        const mir::SurePlanes sure = in_margins(
            planes, share * mir::OcclusionMargins::plane * sigma, mir::OcclusionMargins::hit_share);
        for (int k = 0; k < 8; ++k) {
            const Vec3 p = mirtest::random_leaning_luxel(random, d.cluster);
            const float value = sure.at(pyramid.local(p));
            const bool hit = value > 1.0f;
            const bool missed = value < -1.0f;
            const bool truth = mir::hits_segment(d.rows, p, d.apex);
            ++answers.asked;
            answers.hit += hit ? 1 : 0;
            answers.missed += missed ? 1 : 0;
            answers.wrong_hits += hit && !truth ? 1 : 0;
            answers.wrong_misses += missed && truth ? 1 : 0;
        }
    }
    return answers;
}

}  // namespace

TEST_CASE("What planes say of a segment surely is so") {
    const Answers found = answers(600000, 1.0f, GENERATE(false, true));
    INFO(found.asked << " asked, " << found.hit << " hit, " << found.missed << " missed");
    CHECK(found.hit > 10000);
    CHECK(found.missed > 10000);
    CHECK(found.wrong_hits == 0);
    CHECK(found.wrong_misses == 0);
}

TEST_CASE("Planes with next to no margins say wrong things") {
    const Answers found = answers(200000, 1e-6f);
    CHECK(found.wrong_hits > 20);
    CHECK(found.wrong_misses > 100);
}

TEST_CASE("Nothing is sure of a triangle in whose plane the apex lies, nor of what is no number") {
    const mir::TriangleRows rows = mir::make_triangle_rows({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mir::ClusterRecord cluster;
    cluster.low = Vec3(0.1f, 0.1f, 1.0f);
    cluster.high = Vec3(0.9f, 0.9f, 1.1f);
    cluster.luxels = 1;
    const auto says_something = [&](Vec3 apex, Vec3 end) {
        const mir::Pyramid pyramid = mir::make_pyramid(cluster, apex, 1e-6f);
        ShadowPlanes planes;
        REQUIRE(occlusion(rows, pyramid, planes) == mir::Occlusion::partial);
        const float value = in_margins(planes, 2e-6f, mir::OcclusionMargins::hit_share).at(end);
        return value > 1.0f || value < -1.0f;
    };
    CHECK_FALSE(says_something({0.5f, -3.0f, 0.0f}, Vec3(0)));
    CHECK(says_something({0.2f, 0.2f, -1.0f}, {-0.3f, -0.3f, 0.0f}));
    const float none = std::numeric_limits<float>::quiet_NaN();
    CHECK_FALSE(says_something({0.2f, 0.2f, -1.0f}, Vec3(none)));
}
