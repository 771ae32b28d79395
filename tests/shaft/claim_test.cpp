// SPDX-License-Identifier: MIT
#include "accel/hard_segments.hpp"
#include "mir/accel/exact/accept_box.hpp"
#include "mir/shaft/exact/occlusion.hpp"
#include "mir/shaft/exact/shaft.hpp"
#include "shaft/cluster_draws.hpp"
#include "support/catch.hpp"
#include "support/soa_run.hpp"

// From luxels to answers, over whole scenes: what shafts and pyramids say of every triangle against
// hits_segment() for every luxel.

namespace {

using mir::Hit;
using mir::Vec3;

constexpr std::uint32_t cluster_size = mir::cluster_luxels;

/// Triangles of a scene as structures and tests know them.
struct Triangles {
    std::vector<mir::TriangleRows> rows;
    std::vector<mir::Bounds> boxes;
    float sigma = 0.0f;

    explicit Triangles(const mir::WorldGeometry& g) {
        const float magnitude = mir::magnitude_of(g.bounds());
        sigma = mirtest::float_sigma(magnitude);
        for (std::uint32_t t = 0; t < g.triangles().size(); ++t) {
            const Vec3 a = g.corner(t, 0);
            const Vec3 b = g.corner(t, 1);
            const Vec3 c = g.corner(t, 2);
            rows.push_back(mir::make_triangle_rows(a, b, c));
            boxes.push_back(mir::accept_box(a, b, c, magnitude));
        }
    }
};

/// Luxels on one triangle and around it, some of them empty, lifted by up to eight sigma: surfaces
/// within the margins of rounding are among what is drawn.
std::vector<Hit> random_luxels(const mir::WorldGeometry& g, mir::Random& random) {
    const Hit centre = mirtest::random_hit(g, random, random.next());
    const float size = 0.05f * g.bounds().diagonal() * random.next() * random.next();
    std::vector<Hit> hits(cluster_size);
    for (Hit& h : hits) {
        if (mirtest::chance(random, 0.1f)) continue;
        h = mirtest::hit_beside(centre, size, random);
    }
    return hits;
}

/// On a surface, or one of the luxels.
Vec3 random_vpl(const mir::WorldGeometry& g, mir::Random& random, const std::vector<Hit>& hits) {
    if (mirtest::chance(random, 0.1f)) return hits[0].position;
    return mirtest::random_hit(g, random).position;
}

struct Answers {
    std::size_t refused = 0;  ///< triangles whose box the shaft misses
    std::size_t none = 0;
    std::size_t full = 0;
    std::size_t wrong = 0;
};

/// What is said of the segments between a VPL and a cluster.
struct Pair {
    mir::Shaft shaft;
    mir::Pyramid pyramid;
};

/// Asks about one triangle, and all luxels whether it is true.
void ask(const Pair& pair, const mir::TriangleRows& rows, const mir::Bounds& box,
         const std::vector<Hit>& hits, Answers& answers) {
    const bool refused = !mir::meets_box(pair.shaft, box.low, box.high);
    const mir::Occlusion found = mir::occlusion(rows, pair.pyramid);
    const auto is_hit = [&](const Hit& h) {
        return mir::hits_segment(rows, h.position, pair.pyramid.apex);
    };
    const bool any = std::any_of(hits.begin(), hits.end(),
                                 [&](const Hit& h) { return !is_empty(h) && is_hit(h); });
    const bool all = std::all_of(hits.begin(), hits.end(),
                                 [&](const Hit& h) { return is_empty(h) || is_hit(h); });
    const bool none = found == mir::Occlusion::none;
    const bool full = found == mir::Occlusion::full;
    answers.refused += refused ? 1 : 0;
    answers.none += none ? 1 : 0;
    answers.full += full ? 1 : 0;
    answers.wrong += ((refused || none) && any) || (full && !all) ? 1 : 0;
}

/// `recorded` luxels of each cluster are in its record; all of them should be.
Answers ask(const mirtest::World& world, std::uint32_t recorded, int pairs) {
    const mir::WorldGeometry& g = world.geometry;
    const Triangles triangles(g);
    mir::Random random = mirtest::test_random(6);
    Answers answers;
    for (int i = 0; i < pairs; ++i) {
        const std::vector<Hit> hits = random_luxels(g, random);
        const auto cluster =
            mir::cluster_record(mirtest::HitRun(hits).view(), 0, recorded, triangles.sigma);
        if (cluster.luxels == 0) continue;
        const Vec3 q = random_vpl(g, random, hits);
        const Pair pair{mir::make_shaft(cluster, q, triangles.sigma),
                        mir::make_pyramid(cluster, q, triangles.sigma)};
        for (std::size_t t = 0; t < triangles.rows.size(); ++t)
            ask(pair, triangles.rows[t], triangles.boxes[t], hits, answers);
    }
    return answers;
}

}  // namespace

TEST_CASE("What shafts and pyramids say of triangles is true of every luxel") {
    const auto [scale, x] =
        GENERATE(table<float, float>({{1.0f, 0.0f}, {1e-3f, 0.0f}, {1e3f, 0.0f}, {1.0f, 30.0f}}));
    const bool needles = GENERATE(false, true);
    INFO("scale " << scale << ", moved by " << x << (needles ? ", needles" : ""));
    const Vec3 move(x, 0.3f * x, -x);
    const mirtest::World world = needles ? mirtest::needle_soup(60, 7, scale, move)
                                         : mirtest::triangle_soup(60, 8, scale, move);
    const Answers answers = ask(world, cluster_size, 1500);
    CHECK(answers.refused > 10000);
    CHECK(answers.none > 10000);
    CHECK(answers.full > (needles ? 0u : 100u));
    CHECK(answers.wrong == 0);
}

TEST_CASE("Records that forget most of their luxels are noticed") {
    const mirtest::World world = mirtest::triangle_soup(60, 8);
    CHECK(ask(world, 3, 1500).wrong > 10);
}
