// SPDX-License-Identifier: MIT
#include "mir/micro/ray_gather.hpp"

#include "micro/shining_discs.hpp"
#include "mir/micro/check_gather.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::GatherDirections;
using mir::Hit;
using mir::Lambert;
using mir::Rgb;
using mir::SurfelFace;
using mir::SurfelNode;
using mir::SurfelRadiance;
using mir::SurfelTree;
using mir::Vec3;

namespace {

using Gather = mir::RayGather<mir::Space::host, Lambert>;

float gathered(const SurfelTree& tree, std::span<const SurfelRadiance> radiance,
               const mir::GatherOptions& options, const TestLuxel& at, std::uint64_t index) {
    const Gather gather{tree.view(), radiance.data(), options};
    return gather(at.hit, at.surface, test_random(index)).g;
}

}  // namespace

TEST_CASE(
    "In a room that shines alike everywhere every luxel gathers that light, at any threshold") {
    const World world = shining_room();
    const SurfelTree tree = tree_of(world, 0.01f);
    const auto radiance = shining(tree);
    mir::GatherOptions options;
    options.rays = 64;
    options.threshold = GENERATE(0.0f, 1.0f, 16.0f);
    mir::Random random = test_random(960);
    for (std::uint64_t i = 0; i < 50; ++i) {
        const mir::SurfacePoint p = random_surface_point(world.geometry, random);
        const Vec3 n = world.geometry.front_normal(p.triangle);
        const Vec3 lifted = mir::lift(p.position, n, p.offset);
        const float seen = gathered(tree, radiance, options, luxel(lifted, n), i);
        CHECK(double(seen) == Approx(1.0).epsilon(1e-5));
    }
    // A plane that cuts the walls misses discs around which they go on below: at the horizon.
    double sum = 0.0;
    for (std::uint64_t i = 0; i < 50; ++i) {
        const Vec3 place = 0.5f * point_in_cube(random);
        sum += double(gathered(tree, radiance, options, luxel(place, direction(random)), i)) / 50;
    }
    CHECK((sum > 0.99 && sum < 1.00001));
    options.directions = GatherDirections::uniform;
    options.rays = 4096;
    CHECK(double(gathered(tree, radiance, options, luxel({0, 0, 0}), 961)) ==
          Approx(1.0).epsilon(2e-3));
}

TEST_CASE(
    "What a square sends to the point below comes nearer to the closed form as discs shrink") {
    // Irradiance 4 * (2 / sqrt 2) atan(1 / sqrt 2), by Lambert's formula; a white luxel shows 1 /
    // pi of it.
    const double truth = 1.7408395030 / 3.14159265358979;
    const World world = shining_ceiling();
    mir::GatherOptions options;
    options.rays = 65536;
    options.threshold = 0.0f;
    options.directions = GENERATE(GatherDirections::cosine, GatherDirections::uniform);
    double before = 1.0;
    for (float area : {0.05f, 3e-3f, 2e-4f}) {
        const SurfelTree tree = tree_of(world, area);
        const double seen = gathered(tree, shining(tree), options, luxel({0, 0, 0}), 962);
        const double bias = seen / truth - 1.0;
        // Discs stick out of the border by less than their radius.
        CHECK(bias > -1e-3);
        CHECK(bias < before / 2);
        before = bias;
    }
    CHECK(before < 0.02);
}

TEST_CASE("The bias of approximate rays shrinks with their threshold") {
    const World world = shining_ceiling();
    const SurfelTree tree = tree_of(world, 2e-4f);
    const auto radiance = shining(tree);
    const auto seen = [&](float threshold) {
        mir::GatherOptions options;
        options.rays = 1024;
        options.threshold = threshold;
        double sum = 0.0;
        for (std::uint64_t i = 0; i < 64; ++i)
            sum += double(gathered(tree, radiance, options, luxel({0, 0, 0}), 963 + i)) / 64;
        return sum;
    };
    const double exact = seen(0.0f);
    const double coarse = std::fabs(seen(64.0f) - exact);
    const double fine = std::fabs(seen(1.0f) - exact);
    CHECK(fine < 0.3 * coarse);
    CHECK(fine < 0.02 * exact);
}

TEST_CASE("The back of a disc sends its own light") {
    const World world = shining_ceiling();
    const SurfelTree tree = tree_of(world, 0.01f);
    const auto radiance = shining(tree);
    CHECK(gathered(tree, radiance, {}, luxel({0, 0.5f, 0}), 964) > 0.5f);
    CHECK(gathered(tree, radiance, {}, luxel({0, 1.5f, 0}, {0, -1, 0}), 965) == 0.0f);
}

TEST_CASE("The light of a node is the mean of the discs below, both sides apart") {
    const World world = triangle_soup(50, 966);
    const SurfelTree tree = tree_of(world, 1e-3f);
    mir::InlineExecutor executor;
    const mir::SurfelPatches discs(tree);
    const auto light = [](const SurfelFace& face, std::uint64_t number) {
        mir::Random random = test_random(1000 + number);
        return light_for(face, {random.next(), random.next(), float(number % 2)});
    };
    const auto radiance = mir::light_surfels(discs, light, 1e-4f, executor);
    std::vector<long double> sums(tree.nodes().size());
    double worst = 0.0;
    for (std::size_t i = sums.size(); i-- > 0;) {
        const SurfelNode& node = tree.nodes()[i];
        sums[i] = node.is_leaf() ? static_cast<long double>(tree.area()[i]) * radiance[i].front.r
                                 : sums[i + 1] + sums[node.right];
        const long double power = static_cast<long double>(tree.area()[i]) * radiance[i].front.r;
        worst = std::max(worst, std::fabs(double(power / sums[i] - 1)));
        CHECK(radiance[i].front.b == 0.0f);
        CHECK(double(radiance[i].back.b) == Approx(1.0).epsilon(1e-5));
    }
    CHECK(worst < 20 * 0x1p-22);
    for (std::size_t threads : {2u, 3u}) {
        BackwardsExecutor others{threads};
        CHECK(
            equal_bytes<SurfelRadiance>(radiance, mir::light_surfels(discs, light, 1e-4f, others)));
    }
}

TEST_CASE("Empty luxels, black ones and empty scenes gather nothing") {
    const SurfelTree none = tree_of(World{mir::Scene{}}, 1.0f);
    CHECK(gathered(none, {}, {}, luxel({0, 0, 0}), 967) == 0.0f);
    const SurfelTree tree = tree_of(shining_room(), 0.1f);
    const auto radiance = shining(tree);
    TestLuxel black = luxel({0, 0, 0});
    black.surface.bsdf.reflectance = {};
    CHECK(gathered(tree, radiance, {}, black, 968) == 0.0f);
    CHECK(gathered(tree, radiance, {}, {}, 969) == 0.0f);
}

TEST_CASE("Options of a gather out of range are refused") {
    mir::GatherOptions options;
    SECTION("no ray") { options.rays = 0; }
    SECTION("too many rays") { options.rays = 65537; }
    SECTION("negative") { options.threshold = -1.0f; }
    SECTION("infinite") { options.threshold = std::numeric_limits<float>::infinity(); }
    CHECK_THROWS_AS(mir::check(options), mir::Error);
}
