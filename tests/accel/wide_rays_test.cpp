// SPDX-License-Identifier: MIT
#include "mir/accel/wide/wide_rays.hpp"

#include "conformance/packet_suite.hpp"
#include "conformance/ray_caster_suite.hpp"
#include "conformance/visibility_suite.hpp"
#include "mir/host/wide_bvh_scene.hpp"
#include "support/catch.hpp"
#include "support/wide_statistics.hpp"

TEST_CASE("A wide tree's visibility keeps the axioms") {
    mirtest::visibility_suite<mir::WideBvhScene>();
}

TEST_CASE("A wide tree's packets keep the axiom") { mirtest::packet_suite<mir::WideBvhScene>(); }

TEST_CASE("A wide tree's ray caster keeps the axioms") {
    mirtest::ray_caster_suite<mir::WideBvhScene>();
}

TEST_CASE("A scene traced by a wide tree is the one that was built by any executor") {
    const mirtest::World world = mirtest::sphere_in_box();
    mir::InlineExecutor executor;
    mir::WideBvhOptions options;
    options.leaf_size = 2;
    const mir::WideBvhScene scene(world.geometry, executor, options);
    const mir::WideBvhStatistics made = mir::wide_statistics(scene.tree().nodes());
    CHECK(made.triangles == world.geometry.triangles().size());
    CHECK(made.largest_leaf <= 2);
    CHECK_FALSE(scene.visibility().visible({0.1f, 0.2f, 0.9f}, {0.1f, 0.2f, -0.9f}));
    CHECK(scene.ray_caster().closest_hit({{0.1f, 0.2f, 0.9f}, {0, 0, -1}}).has_value());
}
