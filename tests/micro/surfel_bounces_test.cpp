// SPDX-License-Identifier: MIT
#include "mir/micro/surfel_bounces.hpp"

#include "conformance/brute_force.hpp"
#include "micro/shining_discs.hpp"
#include "mir/micro/surfel_direct_light.hpp"
#include "mir/scene/check_rooms.hpp"
#include "support/backwards_executor.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::Lambert;
using mir::Rgb;
using mir::SurfelFace;
using mir::SurfelLinks;
using mir::SurfelRadiance;
using mir::SurfelTree;

namespace {

constexpr std::uint64_t seed = 970;

mir::GatherOptions rays(std::uint32_t count) {
    mir::GatherOptions options;
    options.rays = count;
    return options;
}

SurfelLinks links_of(const SurfelTree& tree, const mir::GatherOptions& options,
                     const mir::Limits& limits = {}) {
    mir::InlineExecutor executor;
    return {mir::SurfelPatches(tree),
            mir::TreeRays<mir::Space::host>{tree.view()},
            options,
            1e-4f,
            seed,
            limits,
            executor};
}

/// The light of discs that reflect with `reflectance` in a room that shines alike everywhere.
std::vector<std::vector<SurfelRadiance>> bounces_in_furnace(float reflectance,
                                                            const mir::SurfelBounceOptions& options,
                                                            std::size_t threads = 1,
                                                            float patch_area = 0.0f) {
    const World world(mir::builtin::furnace_box(reflectance, 1.0f));
    const BruteForceScene traced(world.geometry);
    const mir::LightTable lights(world.scene, world.geometry);
    const mir::SurfaceTable<Lambert> surfaces(world.scene);
    const mir::SurfelDirectLight<Lambert, decltype(traced.ray_caster()),
                                 decltype(traced.visibility())>
        direct({world.geometry, lights, surfaces, traced.ray_caster(), traced.visibility()}, 16,
               seed);
    const auto albedo = [reflectance](const mir::Surfel&) {
        return Rgb{reflectance, reflectance, reflectance};
    };
    BackwardsExecutor executor{threads};
    const SurfelTree tree(surfels_of(world, 0.1f), albedo, {}, executor);
    const mir::SurfelPatches patches(tree, mir::SurfelPatchOptions{patch_area});
    return mir::surfel_bounces(patches, direct, mir::TreeRays<mir::Space::host>{tree.view()},
                               world.geometry.ray_offset(), options, executor);
}

}  // namespace

TEST_CASE("Links bring a side of a disc what its rays bring") {
    const World world = triangle_soup(40, seed);
    // Rays of whole discs all begin at the centre, as those of a luxel do.
    const SurfelTree tree = tree_of(world, 0.01f, {}, mir::DiscExtent::cover);
    mir::InlineExecutor executor;
    const auto random_light = [](const SurfelFace&, std::uint64_t number) {
        mir::Random random = test_random(seed + number);
        return Rgb{random.next(), random.next(), random.next()};
    };
    const mir::SurfelPatches discs(tree);
    const auto radiance = mir::light_surfels(discs, random_light, 1e-4f, executor);
    const SurfelLinks links = links_of(tree, rays(32));
    const mir::RayGather<mir::Space::host, Lambert> gather{tree.view(), radiance.data(), rays(32)};
    std::size_t lit = 0;
    const auto compare = [&](const SurfelFace& face, std::uint64_t number) {
        const mir::Hit hit = face.place({0.5f, 0.5f});
        const TestLuxel white = luxel(hit.position, hit.normal);
        const Rgb traced = gather(hit, white.surface, {seed, mir::Stream::surfel_gather, number});
        const Rgb linked = links(number, radiance);
        CHECK(double(linked.g) == Approx(double(traced.g)).epsilon(1e-4).margin(1e-7));
        lit += linked.g > 0.0f ? 1 : 0;
        return linked;
    };
    mir::light_surfels(discs, compare, 1e-4f, executor);
    CHECK(lit > 100);
    CHECK(links.bytes() == tree.surfels().size() * 2 * 32 * 4);
}

TEST_CASE("In a room that shines alike everywhere each bounce is the reflectance of the last") {
    mir::SurfelBounceOptions options;
    options.last = 6;
    options.least = 0.0f;
    options.gather = rays(16);
    const float reflectance = GENERATE(0.25f, 0.5f);
    const float patch_area = GENERATE(0.0f, 1.0f);
    const auto bounces = bounces_in_furnace(reflectance, options, 1, patch_area);
    REQUIRE(bounces.size() == 6);
    // The first bounce has the noise of lamp samples, and the second sees it unevenly.
    CHECK(double(bounces[0][0].front.g) == Approx(double(reflectance)).epsilon(0.05));
    for (std::size_t b = 1; b < 6; ++b)
        CHECK(double(bounces[b][0].front.g / bounces[b - 1][0].front.g) ==
              Approx(double(reflectance)).epsilon(b == 1 ? 0.02 : 0.01));
    const auto sum = mir::sum_of(bounces);
    const double all = double(bounces[0][0].front.g) * (1 - std::pow(double(reflectance), 6)) /
                       (1 - double(reflectance));
    CHECK(double(sum[0].front.g) == Approx(all).epsilon(0.02));
}

TEST_CASE("Bounces end where they add too little, or at the last one asked for") {
    mir::SurfelBounceOptions options;
    options.last = 200;
    options.gather = rays(4);
    options.least = 0.01f;
    // 0.5^b of 1 / (1 - 0.5) falls below 0.01 at b = 6: the seventh.
    CHECK(bounces_in_furnace(0.5f, options).size() == 7);
    options.last = 1;
    CHECK(bounces_in_furnace(0.5f, options).size() == 1);
    options.last = 200;
    CHECK(bounces_in_furnace(0.0f, options).size() == 1);
}

TEST_CASE("Threads change no bit of the bounces") {
    mir::SurfelBounceOptions options;
    options.last = 3;
    options.gather = rays(8);
    const auto one = bounces_in_furnace(0.5f, options);
    const auto three = bounces_in_furnace(0.5f, options, 3);
    REQUIRE(one.size() == three.size());
    for (std::size_t b = 0; b < one.size(); ++b)
        CHECK(equal_bytes<SurfelRadiance>(one[b], three[b]));
}

TEST_CASE("Links refuse what they cannot hold") {
    const SurfelTree tree = tree_of(shining_room(), 0.1f);
    mir::GatherOptions uniform = rays(4);
    uniform.directions = mir::GatherDirections::uniform;
    CHECK_THROWS_AS(links_of(tree, uniform), mir::Error);
    mir::Limits limits;
    limits.surfel_link_bytes = tree.surfels().size() * 2 * 4 * 4;
    CHECK(links_of(tree, rays(4), limits).bytes() == limits.surfel_link_bytes);
    CHECK_THROWS_AS(links_of(tree, rays(5), limits), mir::Error);
}
