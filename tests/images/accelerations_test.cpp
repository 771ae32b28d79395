// SPDX-License-Identifier: MIT
//
// One picture through the library's two structures, which give the same bits: by single rays
// through the kd-tree, and by shafts and packets through the wide hierarchy.
#include "images/support.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "support/catch.hpp"
#include "support/masked_scene.hpp"
#include "support/named_scene.hpp"

namespace {

mir::RenderResult render(const mir::Scene& scene, mir::Acceleration acceleration,
                         const char* scheduler) {
    mir::RenderSettings s;
    s.image = {80, 60};
    s.luxels_per_pixel = 1;
    s.vpls = 64;
    s.backend = mir::BackendKind::cpu;
    s.scheduler = scheduler;
    s.acceleration = acceleration;
    s.tile = {48, 32};
    s.allow_no_light = true;
    mir::Registry registry;
    mir::add_all_to(registry);
    return registry.make(s.backend, s.scheduler)->render(scene, s, nullptr);
}

}  // namespace

TEST_CASE("The processor chooses its structure by how many pairs a triangle serves") {
    mir::RenderSettings s = mirtest::small_settings(32, 16);
    const auto used = [&s](const mir::Scene& scene) {
        return mirtest::render(scene, s).statistics.acceleration;
    };
    // 1888 triangles: 128 pairs for each are 236 VPLs of this image.
    const mir::Scene sphere = mir::builtin::make("sphere");
    CHECK(used(sphere) == "embree");
    s.vpls = 235;
    CHECK(used(sphere) == "embree");
    s.vpls = 236;
    CHECK(used(sphere) == "bvh");
    s.luxels_per_pixel = 4;
    s.vpls = 59;
    CHECK(used(sphere) == "bvh");
    s.acceleration = mir::Acceleration::embree;
    CHECK(used(sphere) == "embree");
    s.acceleration = mir::Acceleration::automatic;
    s.integrator = mir::Integrator::path;
    s.path.samples = 1;
    CHECK(used(sphere) == "embree");
    s.integrator = mir::Integrator::vpl;
    mir::Scene masked = mir::builtin::make("cornell-box");
    CHECK(used(masked) == "bvh");
    mirtest::hang_curtain(masked, mir::lambertian("curtain", {0.7f, 0.6f, 0.5f}), 6,
                          {-0.7f, 1.3f, -0.6f}, {1.4f, 0, 0}, {0, 0, 1.2f});
    CHECK(used(masked) == "bvh");
}

TEST_CASE("A scene of more than a million triangles needs more pairs for each", "[extended]") {
    mir::Scene scene = mir::builtin::make("sphere");
    for (mir::Mesh& mesh : scene.meshes)
        if (mesh.name == "sphere")
            mesh = mir::builtin::sphere("sphere", mesh.material, {0, 1.4f, 0}, 1.0f, 1225, 613);
    mir::RenderSettings s = mirtest::small_settings(140, 900);
    s.luxels_per_pixel = 12;
    const mir::RenderStatistics used = mirtest::render(scene, s).statistics;
    REQUIRE(used.triangles > 1'400'000);
    const double for_each = pairs(s) / static_cast<double>(used.triangles);
    REQUIRE(for_each > 130);
    REQUIRE(for_each < 150);
    CHECK(used.acceleration == "embree");
    s.luxels_per_pixel = 14;  // 165 for each
    CHECK(mirtest::render(scene, s).statistics.acceleration == "bvh");
}

TEST_CASE("The kd-tree and the wide hierarchy with shafts draw the same bits", "[extended]") {
    for (const mirtest::NamedScene& named : mirtest::picture_scenes()) {
        const auto scene = mirtest::load_scene(named.name, named.file);
        if (!scene) {
            WARN("skipped: " << named.file << " is not on this machine");
            continue;
        }
        INFO(named.name);
        const mir::RenderResult tree = render(*scene, mir::Acceleration::kd_tree, "cpu-blocks");
        CHECK(tree.statistics.acceleration == "kdtree");
        for (const char* scheduler : {"cpu", "cpu-blocks"}) {
            INFO(scheduler);
            const mir::RenderResult wide = render(*scene, mir::Acceleration::bvh, scheduler);
            CHECK(wide.statistics.acceleration == "bvh");
            CHECK(mirtest::same_bits(tree.direct, wide.direct));
            CHECK(mirtest::same_bits(tree.indirect, wide.indirect));
            CHECK(mirtest::same_bits(tree.beauty, wide.beauty));
        }
    }
}
