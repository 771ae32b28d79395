// SPDX-License-Identifier: MIT
#include "mir/shaft/host/candidate_lanes.hpp"

#include "accel/hard_segments.hpp"
#include "accel/wide_nodes.hpp"
#include "mir/shaft/exact/shaft_slots.hpp"
#include "mir/shaft/exact/shaft_walk.hpp"
#include "shaft/shaft_stage.hpp"
#include "support/catch.hpp"
#include "support/instruction_sets.hpp"

// Sixteen triangles at once against hits_segment() for every luxel, and eight boxes at once
// against meets_box().

namespace {

using mir::Hit;
using mir::Occlusion;
using mir::Vec3;
using mir::detail::CandidateLanes;

struct Answers {
    std::size_t none = 0;
    std::size_t full = 0;
    std::size_t fewer = 0;  ///< that occlusion() shows and lanes do not
    std::size_t wrong = 0;
};

/// A cluster of sixteen luxels, a part of a larger one, and a VPL.
struct Draw {
    std::vector<Hit> luxels;
    Vec3 apex{0};
    float spread = 0.0f;  ///< of the larger one
    mir::ClusterRecord record;
};

Draw draw(const mir::WorldGeometry& g, float sigma, mir::Random& random) {
    Draw d;
    const Hit centre = mirtest::random_hit(g, random, random.next());
    const float size = 0.05f * g.bounds().diagonal() * random.next() * random.next();
    for (int i = 0; i < 16; ++i) d.luxels.push_back(mirtest::hit_beside(centre, size, random));
    d.apex = mirtest::random_hit(g, random).position;
    if (mirtest::chance(random, 0.1f)) d.apex = d.luxels[3].position;
    d.record = mir::cluster_record(mirtest::HitRun(d.luxels).view(), 0, 16, sigma);
    d.spread = (1.0f + random.next()) * mir::max_abs(glm::max(glm::abs(d.record.low - d.apex),
                                                              glm::abs(d.record.high - d.apex)));
    return d;
}

/// Asks for all triangles of a world, sixteen at a time; margins of edges are `factor` times those
/// that are proved.
Answers ask(const mirtest::World& world, int draws, float factor = 1.0f) {
    const mir::WideBvh bvh = mirtest::build_wide(world.geometry);
    const auto groups = mir::make_triangle_lanes(bvh.triangles());
    const float sigma = mirtest::float_sigma(mir::magnitude_of(world.geometry.bounds()));
    mir::Random random = mirtest::test_random(41);
    Answers answers;
    for (int i = 0; i < draws; ++i) {
        const Draw d = draw(world.geometry, sigma, random);
        const mir::Pyramid pyramid = mir::make_pyramid(d.record, d.apex, sigma);
        for (std::size_t t = 0; t < bvh.triangles().size(); ++t) {
            const auto k = static_cast<std::uint32_t>(t % mir::detail::lane_count);
            CandidateLanes lanes;
            prepare_lanes(groups[t / mir::detail::lane_count], d.apex, d.spread, sigma, lanes);
            for (float& margin : lanes.margin.at) margin *= factor;
            const auto found = occlusion(lanes, mir::detail::cluster_box(d.record), sigma);
            const bool none = (found.none >> k & 1u) != 0;
            const bool full = (found.full >> k & 1u) != 0;
            const auto is_hit = [&](const Hit& h) {
                return hits_segment(bvh.triangles()[t], d.apex, h.position);
            };
            const bool any = std::any_of(d.luxels.begin(), d.luxels.end(), is_hit);
            const bool all = std::all_of(d.luxels.begin(), d.luxels.end(), is_hit);
            answers.none += none ? 1 : 0;
            answers.full += full ? 1 : 0;
            answers.fewer +=
                !none && !full && occlusion(bvh.triangles()[t], pyramid) != Occlusion::partial ? 1
                                                                                               : 0;
            answers.wrong += (none && any) || (full && !all) ? 1 : 0;
        }
    }
    return answers;
}

mirtest::World soup(bool needles, float scale, float x) {
    const Vec3 move(x, 0.3f * x, -x);
    return needles ? mirtest::needle_soup(60, 47, scale, move)
                   : mirtest::triangle_soup(60, 48, scale, move);
}

}  // namespace

TEST_CASE("What sixteen triangles at once are said to do is true of every luxel") {
    const auto [scale, x] =
        GENERATE(table<float, float>({{1.0f, 0.0f}, {1e-3f, 0.0f}, {1e3f, 0.0f}, {1.0f, 30.0f}}));
    const bool needles = GENERATE(false, true);
    INFO("scale " << scale << ", moved by " << x << (needles ? ", needles" : ""));
    const Answers answers = ask(soup(needles, scale, x), 300);
    CHECK(answers.none > 5000);
    CHECK(answers.full > (needles ? 0u : 20u));
    CHECK(answers.wrong == 0);
    // Larger margins and another rounding show little less than one triangle at a time.
    CHECK(answers.fewer < (answers.none + answers.full) / 10);
}

namespace {

/// Wrong answers about single luxels behind edges of triangles as seen from the VPL, where rounding
/// decides. Their boxes are points: nothing is grown.
std::size_t wrong_at_edges(const mirtest::World& world, float factor) {
    const mir::WideBvh bvh = mirtest::build_wide(world.geometry);
    const auto groups = mir::make_triangle_lanes(bvh.triangles());
    const float sigma = mirtest::float_sigma(mir::magnitude_of(world.geometry.bounds()));
    const mirtest::ScenePlaces places(world.geometry);
    mir::Random random = mirtest::test_random(43);
    std::size_t wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 apex = places.anywhere(random);
        const Vec3 luxel = apex + 1.3f * (places.on_edge(random) - apex);
        const float spread = mir::max_abs(luxel - apex);
        for (const auto& group : groups) {
            CandidateLanes lanes;
            prepare_lanes(group, apex, spread, sigma, lanes);
            for (float& margin : lanes.margin.at) margin *= factor;
            const auto found = occlusion(lanes, {luxel, Vec3(0.0f)}, sigma);
            for (std::uint32_t k = 0; k < mir::detail::lane_count; ++k) {
                const bool hit = hits_segment(group.rows(k), apex, luxel);
                wrong += ((found.none >> k & 1u) != 0 && hit) ? 1 : 0;
                wrong += ((found.full >> k & 1u) != 0 && !hit) ? 1 : 0;
            }
        }
    }
    return wrong;
}

}  // namespace

TEST_CASE("Edges without margins are noticed") {
    const mirtest::World world = soup(false, 1.0f, 0.0f);
    CHECK(wrong_at_edges(world, 1.0f) == 0);
    CHECK(wrong_at_edges(world, 0.0f) > 10);
}

TEST_CASE("Triangles of 10^20 gradients are never said to do anything that they do not") {
    std::vector<mir::TriangleRows> rows;
    mir::Random random = mirtest::test_random(49);
    for (int i = 0; i < 16; ++i) {
        const Vec3 a = mirtest::point_in_cube(random);
        rows.push_back(mir::make_triangle_rows(a, a + Vec3(0, 0, 1), a + Vec3(1e-20f, 0, 0.5f)));
        const float huge = std::pow(10.0f, 20.0f + static_cast<float>(i));
        rows.back().u = {huge, -huge, 0.5f * huge, huge};
        rows.back().s = {0.6f, 0.8f, 0.0f, 0.1f * static_cast<float>(i) - 0.8f};
    }
    const auto groups = mir::make_triangle_lanes(rows);
    const float sigma = mirtest::float_sigma(1.0f);
    std::size_t wrong = 0;
    for (int i = 0; i < 2000; ++i) {
        Draw d;
        for (int k = 0; k < 16; ++k)
            d.luxels.push_back({0.1f * mirtest::point_in_cube(random), {0, 0, 1}});
        d.apex = mirtest::point_in_cube(random);
        d.record = mir::cluster_record(mirtest::HitRun(d.luxels).view(), 0, 16, sigma);
        CandidateLanes lanes;
        prepare_lanes(groups[0], d.apex, 2.0f, sigma, lanes);
        const auto found = occlusion(lanes, mir::detail::cluster_box(d.record), sigma);
        for (std::uint32_t t = 0; t < 16; ++t)
            for (const Hit& h : d.luxels) {
                const bool hit = hits_segment(rows[t], d.apex, h.position);
                wrong += ((found.none >> t & 1u) != 0 && hit) ? 1 : 0;
                wrong += ((found.full >> t & 1u) != 0 && !hit) ? 1 : 0;
            }
    }
    CHECK(wrong == 0);
}

TEST_CASE("Eight boxes at once are met where they are one by one") {
    mir::Random random = mirtest::test_random(42);
    std::size_t met = 0;
    std::size_t different = 0;
    for (int i = 0; i < 20000; ++i) {
        const mir::ClusterRecord record = mirtest::random_cluster_box(random, 1.0f);
        const Vec3 apex = mirtest::random_apex(random, record, 1.0f);
        mir::Shaft shaft = mir::make_shaft(record, apex, mirtest::float_sigma(1.0f));
        if (mirtest::chance(random, 0.5f)) {
            const Vec3 n = mirtest::direction(random);
            shaft.front = {n.x, n.y, n.z, 0.3f * random.next()};
        }
        mir::WideNode node{};
        for (std::uint32_t k = 0; k < mir::WideNode::width; ++k)
            for (int axis = 0; axis < 3; ++axis) {
                // Half of the planes are those of the cluster, or the VPL's own.
                const auto plane = [&] {
                    const float at[] = {record.low[axis], record.high[axis], apex[axis]};
                    return mirtest::chance(random, 0.5f)
                               ? at[static_cast<int>(2.99f * random.next())]
                               : 2.0f * random.next() - 1.0f;
                };
                const float a = plane();
                const float b = plane();
                node.set_bounds(axis, k, std::min(a, b), std::max(a, b));
            }
        const std::uint32_t wanted = mir::detail::met_slots(node, shaft);
        for (mir::InstructionSet set : mirtest::instruction_sets()) {
            std::uint32_t found = 0;
            mir::run_with(set, [&] { found = mir::SlotShaft(shaft).met(node); });
            different += found != wanted ? 1 : 0;
        }
        met += wanted != 0 ? 1 : 0;
    }
    CHECK(met > 1000);
    CHECK(different == 0);
}
