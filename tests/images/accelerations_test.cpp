// SPDX-License-Identifier: MIT
//
// One picture through the library's two structures, which give the same bits: by single rays
// through the kd-tree, and by shafts and packets through the wide hierarchy.
#include "images/support.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "support/catch.hpp"
#include "support/named_scene.hpp"

namespace {

mir::RenderResult render(const mir::Scene& scene, mir::Acceleration acceleration,
                         const char* scheduler) {
    mir::RenderSettings s;
    s.image = {80, 60};
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
