// SPDX-License-Identifier: MIT
#include "micro/surfel_worlds.hpp"
#include "mir/micro/split_patches.hpp"
#include "support/backwards_executor.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <set>

using namespace mirtest;
using mir::Rgb;
using mir::SurfelFace;
using mir::SurfelNode;
using mir::SurfelPatches;
using mir::SurfelTree;
using mir::Vec3;

namespace {

/// Sheets of 1 m x 1 m that look down, at these heights.
World sheets(std::initializer_list<float> heights) {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    for (const float y : heights)
        scene.place(mir::builtin::quad("sheet", grey, {0, y, 0}, {1, 0, 0}, {0, 0, 1}));
    return World(std::move(scene));
}

/// Discs of each patch.
std::vector<std::span<const mir::Surfel>> discs_of(const SurfelPatches& patches) {
    std::vector<std::span<const mir::Surfel>> discs;
    for (const std::uint32_t i : patches.nodes()) {
        const SurfelNode& node = patches.tree().nodes()[i];
        discs.push_back(patches.tree().surfels().subspan(node.first, node.count));
    }
    return discs;
}

void check_each_disc_once(const SurfelPatches& patches) {
    std::size_t next = 0;
    for (const std::uint32_t i : patches.nodes()) {
        REQUIRE(patches.tree().nodes()[i].first == next);
        next += patches.tree().nodes()[i].count;
    }
    CHECK(next == patches.tree().surfels().size());
}

/// The disc that a point lies a little above, on the side of its normal or, for `side` -1, on the
/// other; their number where there is none.
std::size_t disc_below(std::span<const mir::Surfel> discs, const mir::Hit& hit, float side) {
    for (std::size_t k = 0; k < discs.size(); ++k) {
        const Vec3 off = hit.position - discs[k].position;
        const float above = glm::dot(off, hit.normal);
        if (std::fabs(glm::dot(discs[k].normal, hit.normal) - side) < 1e-5f && above > 0.0f &&
            above < 3e-4f && discs[k].in_piece(off - above * hit.normal, 1e-6f))
            return k;
    }
    return discs.size();
}

/// A spot of light around (0.3, 0.3), as quarters of a patch tell of it.
struct Spot {
    float radius = 0.1f;

    [[nodiscard]] static float distance(Vec3 p) { return std::hypot(p.x - 0.3f, p.z - 0.3f); }
    [[nodiscard]] std::array<Rgb, 4> quarters(const SurfelFace& face, std::uint64_t) const {
        std::array<Rgb, 4> parts;
        for (std::uint32_t i = 0; i < 16; ++i) {
            const mir::Hit hit = face.place({(float(i) + 0.5f) / 16.0f, 0.5f});
            const float on = face.front && distance(hit.position) < radius ? 0.25f : 0.0f;
            parts[i / 4] += Rgb{on, on, on};
        }
        return parts;
    }
};

}  // namespace

TEST_CASE("patches hold every disc once, and are no larger than asked for") {
    const World world = triangle_soup(400, 1501);
    const SurfelTree tree = tree_of(world, 1e-3f);
    CHECK(SurfelPatches(tree).size() == tree.surfels().size());
    check_each_disc_once(SurfelPatches(tree));
    for (const float area : {2e-3f, 1e-2f, 0.1f}) {
        const SurfelPatches patches(tree, mir::SurfelPatchOptions{area});
        check_each_disc_once(patches);
        CHECK(patches.size() < tree.surfels().size());
        for (const auto& discs : discs_of(patches)) {
            if (discs.size() == 1) continue;
            double sum = 0.0;
            Vec3 low = discs[0].position;
            Vec3 high = low;
            for (const mir::Surfel& d : discs) {
                sum += double(d.area);
                low = glm::min(low, d.position);
                high = glm::max(high, d.position);
                CHECK(d.material == discs[0].material);
                CHECK(glm::dot(d.normal, discs[0].normal) > 0.2f);
            }
            CHECK(sum <= 1.001 * double(area));
            CHECK(glm::length(high - low) <= 2.1f * std::sqrt(3.0f * area));
        }
    }
    check_each_disc_once(SurfelPatches(tree_of(World{mir::Scene{}}, 1.0f)));
}

TEST_CASE("a wall of small triangles has as many patches as one of large ones") {
    const World world = sheets({1.0f});
    const mir::SurfelPatchOptions options{1.0f / 256};
    for (const float area : {1.0f / 512, 1.0f / 4096, 1.0f / 32768}) {
        const SurfelTree tree = tree_of(world, area);
        const std::size_t patches = SurfelPatches(tree, options).size();
        CHECK(patches >= 256);
        CHECK(patches <= 512);
    }
}

// Seen from below the upper sheet is hidden; light of lamps between them must not pass through.
TEST_CASE("no patch holds a surface and one behind it, or both sides of a wall") {
    for (const World& world : {sheets({1.0f, 0.99f}), thin_wall()}) {
        const SurfelTree tree = tree_of(world, 1e-4f);
        for (const auto& discs : discs_of(SurfelPatches(tree, mir::SurfelPatchOptions{0.01f})))
            for (const mir::Surfel& d : discs) {
                CHECK(glm::dot(d.position - discs[0].position, discs[0].normal) == Approx(0.0f));
                CHECK(glm::dot(d.normal, discs[0].normal) > 0.99f);
            }
    }
}

// Chi-square over the discs of one patch: level 0.001, seeds 1502 to 1505.
TEST_CASE("places of a patch are uniform by area, and lie in its discs", "[statistical]") {
    const World world = triangle_soup(60, 1502);
    const SurfelTree tree = tree_of(world, 0.05f);
    constexpr std::size_t draws = 40000;
    for (const bool front : {true, false}) {
        const SurfelFace face{tree.view(), 0, front, 1e-4f};
        std::vector<double> observed(tree.surfels().size());
        std::vector<double> expected;
        for (const mir::Surfel& d : tree.surfels())
            expected.push_back(draws * double(d.area) / double(tree.area()[0]));
        mir::Random random = test_random(1503 + (front ? 1 : 0));
        std::size_t outside = 0;
        for (std::size_t i = 0; i < draws; ++i) {
            const std::size_t found =
                disc_below(tree.surfels(), face.place(random.next_2d()), front ? 1.0f : -1.0f);
            if (found < observed.size())
                observed[found] += 1.0;
            else
                ++outside;
        }
        CHECK(outside == 0);
        CHECK(chi_square(observed, expected).p_value > 0.001);
    }
}

TEST_CASE("the discs of a patch share the light on it, each with its albedo") {
    const World world = sheets({1.0f});
    mir::InlineExecutor executor;
    const auto albedo = [](const mir::Surfel& d) {
        return d.position.x < 0.5f ? Rgb{0.2f, 0.4f, 0.0f} : Rgb{0.8f, 0.1f, 0.0f};
    };
    const SurfelTree tree(surfels_of(world, 1e-3f), albedo, {}, executor);
    const SurfelPatches patches(tree, mir::SurfelPatchOptions{0.05f});
    const auto light = [](const SurfelFace&, std::uint64_t number) {
        return Rgb{float(1 + number), 2.0f, 3.0f};
    };
    const auto radiance = mir::light_surfels(patches, light, 1e-4f, executor);
    for (std::size_t p = 0; p < patches.size(); ++p) {
        const SurfelNode& top = tree.nodes()[patches.nodes()[p]];
        for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
            const SurfelNode& leaf = tree.nodes()[i];
            if (!leaf.is_leaf() || leaf.first < top.first || leaf.first >= top.first + top.count)
                continue;
            const Rgb own = albedo(tree.surfels()[leaf.first]);
            CHECK(radiance[i].front == Rgb{float(1 + 2 * p), 2.0f, 3.0f} * own);
            CHECK(radiance[i].back == Rgb{float(2 + 2 * p), 2.0f, 3.0f} * own);
        }
    }
}

TEST_CASE("patches are split where light ends, and nowhere else") {
    const World world = sheets({1.0f});
    const SurfelTree tree = tree_of(world, 1.0f / 8192);
    const SurfelPatches coarse(tree, mir::SurfelPatchOptions{1.0f / 64});
    BackwardsExecutor executor{1};
    CHECK(mir::split_patches(coarse, Spot{2.0f}, 1e-4f, executor).size() == coarse.size());
    CHECK(mir::split_patches(coarse, Spot{0.0f}, 1e-4f, executor).size() == coarse.size());
    const SurfelPatches split = mir::split_patches(coarse, Spot{}, 1e-4f, executor);
    check_each_disc_once(split);
    const std::set<std::uint32_t> before(coarse.nodes().begin(), coarse.nodes().end());
    std::uint32_t least = 1000;
    for (const std::uint32_t i : split.nodes()) {
        const SurfelNode& node = tree.nodes()[i];
        const float from_rim = std::fabs(Spot::distance(node.centre) - Spot{}.radius);
        if (!before.contains(i)) CHECK(from_rim < 0.2f);
        if (from_rim > 0.2f) CHECK(node.count >= 64);
        least = std::min(least, node.count);
    }
    CHECK(least <= 16);
    BackwardsExecutor others{3};
    const SurfelPatches again = mir::split_patches(coarse, Spot{}, 1e-4f, others);
    CHECK(std::equal(again.nodes().begin(), again.nodes().end(), split.nodes().begin(),
                     split.nodes().end()));
}
