// SPDX-License-Identifier: MIT
#include "mir/paths/path_generator.hpp"

#include "mir/scenes.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/path_lab.hpp"
#include "support/wedge.hpp"

namespace {

using mir::Lambert;
using mir::PathGenerator;
using mir::PathTechniques;
using mir::Stream;
using mir::TechniqueTable;
using mir::WeightedPath;
using mirtest::PathLab;
using mirtest::Wedge;
using mirtest::WedgeLights;
using World = PathLab<Lambert>::World;

/// A scene all of whose lengths are `scale` times as long.
mir::Scene scaled(mir::Scene scene, float scale) {
    for (mir::Mesh& mesh : scene.meshes)
        for (mir::Vec3& p : mesh.positions) p *= scale;
    scene.cameras[0].position *= scale;
    return scene;
}

}  // namespace

TEST_CASE("weights of paths of up to 64 edges do not depend on the scale of the scene") {
    // Powers of two, so that not even rounding may differ. A product of 64 squared distances of
    // 1000 km or 1 um is far outside the range of double.
    const float scale = GENERATE(0x1p-20f, 0x1p-10f, 0x1p10f, 0x1p20f);
    const std::uint32_t shortest = GENERATE(2u, 60u);
    CAPTURE(scale, shortest);
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    const PathLab<Lambert> other(scaled(lab.scene, scale));
    const TechniqueTable table(shortest, mir::max_path_edges, PathTechniques::bidirectional);
    const PathGenerator<World> a(lab.world(), table);
    const PathGenerator<World> b(other.world(), table);
    WeightedPath p;
    WeightedPath q;
    std::uint32_t longest = 0;
    for (std::uint64_t i = 0; i < 5000; ++i) {
        const mir::Random u(600, Stream::test, i);
        a.generate(u, p);
        b.generate(u, q);
        REQUIRE(p.weight == q.weight);
        if (p.weight > 0.0) longest = std::max(longest, p.path.edges());
    }
    CHECK(longest > shortest + 3);
}

TEST_CASE("a path has the length and the ends that its table allows") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::two_sided).scene());
    const PathGenerator<World> generator(lab.world(), {3, 6, PathTechniques::bidirectional});
    WeightedPath p;
    int lit = 0;
    for (std::uint64_t i = 0; i < 5000; ++i) {
        generator.generate(mir::Random(601, Stream::test, i), p);
        REQUIRE(p.weight >= 0.0);
        if (p.weight == 0.0) continue;
        ++lit;
        REQUIRE(p.path.edges() >= 3);
        REQUIRE(p.path.edges() <= 6);
        REQUIRE(p.density > 0.0);
        REQUIRE(p.weight * p.density == mirtest::Approx(luminance(p.measure.contribution)));
        REQUIRE(lab.lights.light_of(p.path.x(p.path.edges()).triangle));
    }
    CHECK(lit > 500);
}

TEST_CASE("the same numbers make the same path, whatever was in its memory") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::ceiling).scene());
    const PathGenerator<World> generator(lab.world(), {2, 12, PathTechniques::bidirectional});
    WeightedPath used;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const mir::Random u(602, Stream::test, i);
        WeightedPath fresh;
        generator.generate(u, used);
        generator.generate(u, fresh);
        REQUIRE(used.weight == fresh.weight);
        if (fresh.weight == 0.0) continue;
        REQUIRE(used.path.edges() == fresh.path.edges());
        REQUIRE(used.path.x(2).position == fresh.path.x(2).position);
    }
}

TEST_CASE("lengths outside 2 to 64 edges are refused") {
    CHECK_THROWS_AS(TechniqueTable(1, 4, PathTechniques::camera), mir::Error);
    CHECK_THROWS_AS(TechniqueTable(4, 3, PathTechniques::camera), mir::Error);
    CHECK_THROWS_AS(TechniqueTable(2, 65, PathTechniques::camera), mir::Error);
    CHECK_NOTHROW(TechniqueTable(2, 64, PathTechniques::bidirectional));
}

TEST_CASE("the techniques of a length share it, and leave the camera its vertices") {
    const TechniqueTable all(2, 64, PathTechniques::bidirectional);
    for (std::uint32_t from_eye : {1u, 2u}) {
        const TechniqueTable table = from_eye == 1 ? all : all.behind_second_vertex();
        for (std::uint32_t k = from_eye + 1; k <= 64; ++k) {
            double sum = 0.0;
            for (std::uint32_t s = 0; s <= k - from_eye; ++s) sum += table.probability_of({k, s});
            CHECK(std::fabs(sum - 1.0) < 1e-12);
            CHECK(table.probability_of({k, k - from_eye + 1}) == 0.0);
        }
    }
    const TechniqueTable nine(9, 9, PathTechniques::bidirectional);
    CHECK(nine.sample(0.0).from_light == 0);
    CHECK(nine.sample(0x1.fffffep-1).from_light == 8);
    CHECK(nine.behind_second_vertex().sample(0x1.fffffep-1).from_light == 7);
}

// H0: techniques are drawn with their probabilities. Chi-square over 20 000 numbers, 0.5 % for each
// table; seed 603.
TEST_CASE("lengths and splits are drawn with their probabilities", "[statistical]") {
    const TechniqueTable all(2, 9, PathTechniques::bidirectional);
    const TechniqueTable table = GENERATE(false, true) ? all.behind_second_vertex() : all;
    std::vector<double> observed(100);
    std::vector<double> expected(100);
    constexpr std::uint32_t draws = 20'000;
    for (std::uint32_t k = 2; k <= 9; ++k)
        for (std::uint32_t s = 0; s < k; ++s)
            expected[k * 10 + s] = draws * table.probability(k) * table.probability_of({k, s});
    for (std::uint32_t i = 0; i < draws; ++i) {
        const auto u = static_cast<double>(mir::Random(603, Stream::test, i).at(0));
        const mir::Technique t = table.sample(u);
        ++observed[t.edges * 10 + t.from_light];
    }
    CHECK(mirtest::chi_square(observed, expected).p_value > 0.005);
    std::swap(expected[40], expected[90]);
    CHECK(mirtest::chi_square(observed, expected).p_value < 1e-6);
}
