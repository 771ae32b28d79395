// SPDX-License-Identifier: MIT
#pragma once

#include "shaft/shaft_stage.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace mirtest {

/// A configuration on which shafts go wrong first, and the words that are true.
struct AdversarialCase {
    std::string name;
    ShaftStage stage;
    std::vector<std::uint32_t> truth;
};

/// Triangles by their corners, far above a larger one: all else lies within reach.
inline World world_of(std::vector<mir::Vec3> corners) {
    using mir::Vec3;
    for (const Vec3 c : {Vec3(-3, -3, -2), Vec3(3, -3, -2), Vec3(0, 3, -2)}) corners.push_back(c);
    mir::Mesh mesh;
    mesh.positions = corners;
    for (std::uint32_t i = 0; i + 2 < corners.size(); i += 3)
        mesh.triangles.push_back({i, i + 1, i + 2});
    mir::Scene scene;
    mesh.material = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(std::move(mesh));
    return World(std::move(scene));
}

/// A square in the plane z = height, cut along the diagonal x = y.
inline std::vector<mir::Vec3> square(float half, float height) {
    const mir::Vec3 a(-half, -half, height), b(half, -half, height), c(half, half, height),
        d(-half, half, height);
    return {a, b, c, a, c, d};
}

/// 16 x 16 luxels on z = 0, half an edge `half` around the origin, that look up.
inline std::vector<mir::Hit> floor_luxels(float half) {
    std::vector<mir::Hit> luxels;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            luxels.push_back({half * (mir::Vec3(x, y, 0) / 7.5f - mir::Vec3(1, 1, 0)), {0, 0, 1}});
    return luxels;
}

/// Small triangles around a place half a metre above the origin.
inline World crowd_of(std::uint32_t count) {
    mir::Random random = test_random(34);
    std::vector<mir::Vec3> corners;
    for (std::uint32_t i = 0; i < count; ++i) {
        const mir::Vec3 centre = mir::Vec3(0, 0, 0.5f) + 0.3f * point_in_cube(random);
        for (int k = 0; k < 3; ++k) corners.push_back(centre + 0.01f * point_in_cube(random));
    }
    return world_of(std::move(corners));
}

/// A number and the floats next to it.
inline std::vector<float> neighbours(float x) {
    return {std::nextafter(x, -1e30f), x, std::nextafter(x, 1e30f)};
}

/// Lamps that look down and lamps that look up at each place; the truth by every triangle.
inline AdversarialCase case_of(std::string name, const World& world, std::vector<mir::Hit> luxels,
                               const std::vector<mir::Vec3>& lamps) {
    Lit lit{std::move(luxels), {}};
    for (const mir::Vec3 p : lamps)
        for (const float z : {-1.0f, 1.0f}) lit.vpls.push_back({p, {0, 0, z}, {1.0f, 1.0f, 1.0f}});
    ShaftStage stage(world.geometry, std::move(lit));
    auto truth = stage.by_brute_force();
    return {std::move(name), std::move(stage), std::move(truth)};
}

inline AdversarialCase vpls_on_boxes() {
    const World world = triangle_soup(80, 31);
    std::vector<mir::Hit> luxels;
    mir::Random random = test_random(32);
    for (int i = 0; i < 256; ++i)
        luxels.push_back({0.3f * point_in_cube(random), direction(random)});
    const ShaftStage unlit(world.geometry, {luxels, {}});
    std::vector<mir::Vec3> lamps;
    for (const mir::ClusterRecord& c : unlit.clusters())
        for (int k = 0; k < 27; ++k) {
            const mir::Vec3 share(k % 3, k / 3 % 3, k / 9);
            lamps.push_back(glm::mix(c.low, c.high, 0.5f * share));
        }
    return case_of("VPLs on faces, edges and corners of clusters' boxes", world, luxels, lamps);
}

inline std::vector<mir::Vec3> lamps_of_soup() {
    mir::Random random = test_random(36);
    std::vector<mir::Vec3> lamps;
    for (int j = 0; j < 20; ++j) lamps.push_back(point_in_cube(random));
    return lamps;
}

inline AdversarialCase vpls_at_luxels() {
    mir::Random random = test_random(35);
    std::vector<mir::Hit> luxels;
    for (int i = 0; i < 256; ++i)
        luxels.push_back(
            {mir::Vec3(0.1f, 0.2f, 0.3f) + 0.1f * point_in_cube(random), direction(random)});
    std::vector<mir::Vec3> lamps = lamps_of_soup();
    for (const std::size_t i : {0u, 100u}) lamps.push_back(luxels[i].position);
    return case_of("VPLs at luxels", triangle_soup(80, 33), luxels, lamps);
}

/// 10^-20 m wide, standing on each other above the origin: their rows have gradients of 10^20.
inline AdversarialCase slivers() {
    using mir::Vec3;
    std::vector<Vec3> corners;
    for (const float foot : {0.2f, 0.4f, 0.6f})
        for (const Vec3 c :
             {Vec3(0, 0, foot), Vec3(0, 0, foot + 0.2f), Vec3(1e-20f, 0, foot + 0.1f)})
            corners.push_back(c);
    return case_of("slivers of next to no width", world_of(corners), floor_luxels(0.5f),
                   {{0, 0, 1}, {0.1f, 0.1f, 1.0f}});
}

/// Each half as large as the one around it, so that a tree over them is deep.
inline AdversarialCase nested_squares() {
    std::vector<mir::Vec3> corners;
    for (int k = 0; k < 60; ++k)
        for (const mir::Vec3 c : square(std::ldexp(1.0f, -k), 0.5f)) corners.push_back(c);
    return case_of("squares nested sixty deep", world_of(corners), floor_luxels(0.3f),
                   {{0, 0, 1}, {1e-3f, 2e-3f, 1.0f}, {1e-15f, 0, 0.75f}, {2.0f, 0, 0.6f}});
}

/// Boxes of no height, segments that keep one or two coordinates.
inline AdversarialCase along_axes() {
    std::vector<mir::Vec3> corners = square(0.25f, 0.25f);
    for (const mir::Vec3 c : square(0.5f, 0.5f)) corners.push_back(c);
    for (const mir::Vec3 c : square(0.5f, 0.25f)) corners.push_back({c.z, c.x, c.y});
    return case_of("squares, luxels and segments along axes", world_of(corners), floor_luxels(0.5f),
                   {{-0.5f, -0.5f, 1}, {0.5f, 0.5f, 1}, {-0.5f, 0.5f, 0.75f}, {0, 0, 0.25f}});
}

/// The truth is single segments, which are cut where they leave reach.
inline AdversarialCase no_numbers_and_beyond_reach() {
    const World world = soup(false);
    Lit lit = random_lit(world.geometry, 500, 40, test_random(22));
    for (std::size_t i = 0; i < lit.luxels.size(); i += 5) lit.luxels[i].position *= 40.0f;
    for (std::size_t j = 0; j < lit.vpls.size(); j += 3) lit.vpls[j].position *= 1e4f;
    for (std::size_t i = 7; i < lit.luxels.size(); i += 70)
        lit.luxels[i].position[static_cast<int>(i % 3)] = std::numeric_limits<float>::quiet_NaN();
    ShaftStage stage(world.geometry, std::move(lit));
    auto truth = stage.by_segments();
    return {"luxels and VPLs beyond reach, luxels that are no number", std::move(stage),
            std::move(truth)};
}

/// All of them, for every form of shafts on every machine.
inline std::vector<AdversarialCase> adversarial_cases() {
    std::vector<AdversarialCase> cases;
    for (const float height : neighbours(0.0f))
        cases.push_back(case_of("an occluder in the luxels' plane and one float beside it",
                                world_of(square(2.0f, height)), floor_luxels(0.5f),
                                {{-0.7f, 0.1f, 1.0f}, {0.0f, 0.1f, 1.0f}, {0.3f, 0.1f, 1.0f}}));
    for (const float height : neighbours(0.5f))
        cases.push_back(case_of("VPLs in an occluder's plane, on its edges and corners",
                                world_of(square(0.25f, height)), floor_luxels(0.5f),
                                {{0.1f, 0.05f, 0.5f},
                                 {0.2f, 0.2f, 0.5f},
                                 {0.25f, 0.0f, 0.5f},
                                 {0.25f, 0.25f, 0.5f},
                                 {0.9f, 0.0f, 0.5f},
                                 {0.1f, 0.0f, 0.9f}}));
    // Seen from height 1, a square of half the cluster's edge at height 1/2 is as large as it.
    for (const float half : neighbours(0.25f))
        cases.push_back(case_of("a square that ends where the shaft does",
                                world_of(square(half, 0.5f)), floor_luxels(0.5f),
                                {{0, 0, 1}, {0.2f, 0, 1}}));
    cases.push_back(case_of("two triangles that cover a cluster only together",
                            world_of(square(1.0f, 0.5f)), floor_luxels(0.5f),
                            {{0.0f, 0.0f, 1.0f}, {0.01f, 0.01f, 1.0f}, {2.0f, 0.5f, 0.6f}}));
    cases.push_back(case_of("luxels at one place", triangle_soup(80, 33),
                            std::vector<mir::Hit>(256, {{0.1f, 0.2f, 0.3f}, {0, 0, 1}}),
                            lamps_of_soup()));
    cases.push_back(case_of("a hundred thousand triangles in front of one cluster",
                            crowd_of(100'000), floor_luxels(0.3f),
                            {{0, 0, 1}, {0.2f, 0.1f, 1.2f}, {1.5f, 0.1f, 0.5f}}));
    for (const auto make : {vpls_on_boxes, vpls_at_luxels, slivers, nested_squares, along_axes,
                            no_numbers_and_beyond_reach})
        cases.push_back(make());
    return cases;
}

}  // namespace mirtest
