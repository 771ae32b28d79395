// SPDX-License-Identifier: MIT
#include "mir/accel/kd/kd_rays.hpp"

#include "accel/simple_kd_tree.hpp"
#include "conformance/packet_suite.hpp"
#include "conformance/ray_caster_suite.hpp"
#include "conformance/visibility_suite.hpp"
#include "support/catch.hpp"

namespace {

/// What the suites ask for: a model of each concept from a geometry.
class Engine {
 public:
    explicit Engine(const mir::WorldGeometry& geometry) : geometry_(&geometry), tree_(geometry) {}

    [[nodiscard]] mir::KdTreeVisibility<mir::Space::host> visibility() const {
        return {tree_.view()};
    }
    [[nodiscard]] mir::KdRayCaster<mir::Space::host> ray_caster() const {
        return {*geometry_, tree_.view()};
    }

 private:
    const mir::WorldGeometry* geometry_;
    mirtest::SimpleKdTree tree_;
};

}  // namespace

TEST_CASE("A kd-tree's visibility keeps the axioms") { mirtest::visibility_suite<Engine>(); }

TEST_CASE("A kd-tree's packets keep the axiom") { mirtest::packet_suite<Engine>(); }

TEST_CASE("A kd-tree's ray caster keeps the axioms") { mirtest::ray_caster_suite<Engine>(); }

TEST_CASE("A kd-tree's packet without active lanes sees nothing") {
    const mirtest::World world{mir::Scene{}};
    const Engine engine(world.geometry);
    const mir::PointPacket points{};
    CHECK(engine.visibility().visible_packet({1, 1, 1}, points, 0) == 0);
    CHECK(engine.visibility().visible_packet({1, 1, 1}, points, 0x8001) == 0x8001);
}
