// SPDX-License-Identifier: MIT
#include "mir/scene/builtin/shapes.hpp"
#include "shaft/shaft_stage.hpp"
#include "support/catch.hpp"

// Configurations on which shafts go wrong first, each against every triangle asked.

namespace {

using mir::Hit;
using mir::Vec3;
using mirtest::Lit;
using mirtest::ShaftStage;

const Vec3 up{0, 0, 1};

/// Triangles by their corners, far above a larger one: all else lies within reach.
mirtest::World world_of(std::vector<Vec3> corners) {
    for (Vec3 c : {Vec3(-3, -3, -2), Vec3(3, -3, -2), Vec3(0, 3, -2)}) corners.push_back(c);
    mir::Mesh mesh;
    mesh.positions = corners;
    for (std::uint32_t i = 0; i + 2 < corners.size(); i += 3)
        mesh.triangles.push_back({i, i + 1, i + 2});
    mir::Scene scene;
    mesh.material = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(std::move(mesh));
    return mirtest::World(std::move(scene));
}

/// A square in the plane z = height, cut along the diagonal x = y.
std::vector<Vec3> square(float half, float height) {
    const Vec3 a(-half, -half, height), b(half, -half, height), c(half, half, height),
        d(-half, half, height);
    return {a, b, c, a, c, d};
}

/// 16 x 16 luxels on z = 0, half an edge `half` around the origin.
std::vector<Hit> floor_luxels(float half) {
    std::vector<Hit> luxels;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            luxels.push_back({half * (Vec3(x, y, 0) / 7.5f - Vec3(1, 1, 0)), up});
    return luxels;
}

mir::Vpl lamp_at(Vec3 position, Vec3 normal = -up) {
    return {position, normal, {1.0f, 1.0f, 1.0f}};
}

/// Bits that differ from the truth, for lamps that look down and for lamps that look up.
std::size_t wrong_bits(const mirtest::World& world, const std::vector<Hit>& luxels,
                       const std::vector<Vec3>& lamps) {
    Lit lit{luxels, {}};
    for (Vec3 p : lamps)
        for (Vec3 normal : {-up, up}) lit.vpls.push_back(lamp_at(p, normal));
    const ShaftStage stage(world.geometry, lit);
    return mirtest::different_bits(stage.by_shafts(), stage.by_brute_force());
}

/// A number and the floats next to it.
std::vector<float> neighbours(float x) {
    return {std::nextafter(x, -1e30f), x, std::nextafter(x, 1e30f)};
}

}  // namespace

TEST_CASE("A VPL on faces, edges and corners of a cluster's box gives the same bits") {
    const mirtest::World world = mirtest::triangle_soup(80, 31);
    std::vector<Hit> luxels;
    mir::Random random = mirtest::test_random(32);
    for (int i = 0; i < 256; ++i)
        luxels.push_back({0.3f * mirtest::point_in_cube(random), mirtest::direction(random)});
    const ShaftStage stage(world.geometry, {luxels, {}});
    std::vector<Vec3> lamps;
    for (const mir::ClusterRecord& c : stage.clusters())
        for (int k = 0; k < 27; ++k) {
            const Vec3 share(0.5f * static_cast<float>(k % 3), 0.5f * static_cast<float>(k / 3 % 3),
                             0.5f * static_cast<float>(k / 9));
            lamps.push_back(glm::mix(c.low, c.high, share));
        }
    CHECK(wrong_bits(world, luxels, lamps) == 0);
}

TEST_CASE("An occluder in the luxels' plane, and one float above and below, gives the same bits") {
    std::vector<Vec3> lamps;
    for (float x : {-0.7f, 0.0f, 0.3f}) lamps.push_back({x, 0.1f, 1.0f});
    for (float height : neighbours(0.0f)) {
        CAPTURE(height);
        CHECK(wrong_bits(world_of(square(2.0f, height)), floor_luxels(0.5f), lamps) == 0);
    }
}

TEST_CASE("A VPL in and next to an occluder's plane, on its edges and corners, changes no bit") {
    for (float height : neighbours(0.5f)) {
        CAPTURE(height);
        const std::vector<Vec3> lamps{{0.1f, 0.05f, 0.5f},
                                      {0.2f, 0.2f, 0.5f},
                                      {0.25f, 0.0f, 0.5f},
                                      {0.25f, 0.25f, 0.5f},
                                      {0.9f, 0.0f, 0.5f}};
        CHECK(wrong_bits(world_of(square(0.25f, height)), floor_luxels(0.5f), lamps) == 0);
    }
}

TEST_CASE("Two triangles that share the diagonal in front of a cluster never cover as one") {
    const mirtest::World world = world_of(square(1.0f, 0.5f));
    const std::vector<Hit> luxels = floor_luxels(0.5f);
    CHECK(wrong_bits(world, luxels, {{0.0f, 0.0f, 1.0f}, {0.01f, 0.01f, 1.0f}}) == 0);
    mir::PairTally counts;
    const ShaftStage stage(world.geometry, {luxels, {lamp_at({0.0f, 0.0f, 1.0f})}});
    static_cast<void>(stage.by_shafts({}, counts));
    CHECK(counts.block(mir::PairState::listed) == 1);
}

TEST_CASE("A triangle that ends where the shaft does gives the same bits") {
    // Seen from height 1, a square of half the cluster's edge at height 1/2 is as large as it.
    for (float half : neighbours(0.25f))
        CHECK(wrong_bits(world_of(square(half, 0.5f)), floor_luxels(0.5f), {{0, 0, 1}}) == 0);
}

TEST_CASE("Luxels at one place give the same bits") {
    const mirtest::World world = mirtest::triangle_soup(80, 33);
    const std::vector<Hit> luxels(256, {{0.1f, 0.2f, 0.3f}, up});
    CHECK(wrong_bits(world, luxels, {{0.1f, 0.2f, 0.9f}, {0, 0, 1.1f}}) == 0);
}

TEST_CASE("A VPL at a luxel gives the same bits") {
    const mirtest::World world = mirtest::triangle_soup(80, 33);
    mir::Random random = mirtest::test_random(35);
    std::vector<Hit> luxels;
    for (int i = 0; i < 256; ++i)
        luxels.push_back({Vec3(0.1f, 0.2f, 0.3f) + 0.1f * mirtest::point_in_cube(random),
                          mirtest::direction(random)});
    CHECK(wrong_bits(world, luxels, {luxels[0].position, luxels[100].position}) == 0);
}

TEST_CASE("Slivers of next to no width give the same bits") {
    // 10^-20 m wide, standing on each other above the origin: their rows have gradients of 10^20.
    std::vector<Vec3> corners;
    for (float foot : {0.2f, 0.4f, 0.6f})
        for (Vec3 c : {Vec3(0, 0, foot), Vec3(0, 0, foot + 0.2f), Vec3(1e-20f, 0, foot + 0.1f)})
            corners.push_back(c);
    const mirtest::World world = world_of(corners);
    REQUIRE(world.geometry.triangles().size() == 4);
    CHECK(wrong_bits(world, floor_luxels(0.5f), {{0, 0, 1}, {0.1f, 0.1f, 1.0f}}) == 0);
}

TEST_CASE("Thousands of triangles in front of one cluster are given up on, and right") {
    mir::Random random = mirtest::test_random(34);
    std::vector<Vec3> corners;
    for (int i = 0; i < 5000; ++i) {
        const Vec3 centre = Vec3(0, 0, 0.5f) + 0.3f * mirtest::point_in_cube(random);
        for (int k = 0; k < 3; ++k)
            corners.push_back(centre + 0.01f * mirtest::point_in_cube(random));
    }
    const mirtest::World world = world_of(corners);
    Lit lit{floor_luxels(0.3f), {lamp_at({0, 0, 1}), lamp_at({0.2f, 0.1f, 1.2f})}};
    const ShaftStage stage(world.geometry, lit);
    const std::vector<std::uint32_t> truth = stage.by_brute_force();
    mir::PairTally counts;
    CHECK(mirtest::different_bits(stage.by_shafts({}, counts), truth) == 0);
    // More than a list can hold: it is as full as it may be, not fuller.
    const mir::ShaftLimits loose{{100000, 1000}, {100000, 1000}};
    CHECK(mirtest::different_bits(stage.by_shafts(loose), truth) == 0);
    CHECK(counts.block(mir::PairState::unknown) == 2);
    CHECK(counts.cluster(mir::PairState::unknown) > 0);
}
