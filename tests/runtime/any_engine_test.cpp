// SPDX-License-Identifier: MIT
#include "mir/runtime/any_engine.hpp"

#include "conformance/block_suite.hpp"
#include "conformance/brute_force.hpp"
#include "conformance/packet_suite.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/concepts/archetypes.hpp"
#include "mir/host/shaft_scene.hpp"
#include "support/brute_force_view.hpp"

using mir::AnyEngine;

namespace {

/// Rays and segments of an engine and of an AnyEngine over it: how often something is met, and how
/// often the two do not say the same.
struct Comparison {
    std::size_t hits = 0;
    std::size_t hidden = 0;
    std::size_t different = 0;
};

template <class Engine>
Comparison compare(const Engine& engine) {
    const AnyEngine any(engine);
    mir::Random random = mirtest::test_random(61);
    Comparison c;
    for (int i = 0; i < 2000; ++i) {
        const mir::Vec3 a = mirtest::point_in_cube(random);
        const mir::Vec3 b = mirtest::point_in_cube(random);
        const auto wanted = engine.ray_caster().closest_hit({a, glm::normalize(b - a)});
        const auto found = any.ray_caster().closest_hit({a, glm::normalize(b - a)});
        const bool visible = engine.visibility().visible(a, b);
        c.hits += wanted ? 1 : 0;
        c.hidden += visible ? 0 : 1;
        const bool same_hit = wanted.has_value() == found.has_value() &&
                              (!wanted || (wanted->triangle == found->triangle &&
                                           wanted->position == found->position));
        if (!same_hit || any.visibility().visible(a, b) != visible) ++c.different;
    }
    return c;
}

template <class Engine>
void has_the_bits_of() {
    const mirtest::World world = mirtest::triangle_soup(80, 21);
    const Engine engine(world.geometry);
    const Comparison c = compare(engine);
    CHECK(c.hits > 200);
    CHECK(c.hidden > 200);
    CHECK(c.different == 0);
    const mirtest::PacketCount packets = mirtest::scattered_packets(
        AnyEngine(engine).visibility(), mirtest::Referee(world.geometry), 200);
    CHECK(packets.seen > 100);
    CHECK(packets.different == 0);
}

/// A ShaftScene whose blocks are asked by virtual calls.
struct ShaftsBehindCalls {
    explicit ShaftsBehindCalls(const mir::WorldGeometry& geometry) : scene(geometry), any(scene) {}
    [[nodiscard]] mir::AnyBlockVisibility visibility() const { return any.block_visibility(); }

    mir::ShaftScene scene;
    AnyEngine any;
};

/// Meets a surface as far as it may look.
struct MeetsAtReach {
    [[nodiscard]] std::optional<mir::SurfacePoint> closest_hit(mir::Ray ray,
                                                               float reach = 100.0f) const {
        mir::SurfacePoint point;
        point.position = ray.origin + reach * ray.direction;
        return point;
    }
};

struct EngineWithReach {
    [[nodiscard]] MeetsAtReach ray_caster() const { return {}; }
    [[nodiscard]] mir::archetype::Visibility visibility() const {
        return mir::archetype::Visibility{mir::archetype::make};
    }
};

}  // namespace

TEST_CASE("An engine behind virtual calls gives the engine's bits, with packets or without") {
    has_the_bits_of<mir::KdTreeScene>();
    static_assert(!mir::PacketVisibility<
                  decltype(std::declval<const mirtest::BruteForceRows&>().visibility())>);
    has_the_bits_of<mirtest::BruteForceRows>();
}

TEST_CASE("An engine behind virtual calls answers blocks where its own visibility does") {
    const mirtest::World world = mirtest::triangle_soup(80, 21);
    CHECK(AnyEngine(mir::ShaftScene(world.geometry)).answers_blocks());
    CHECK_FALSE(AnyEngine(mir::KdTreeScene(world.geometry)).answers_blocks());
    mirtest::block_suite<ShaftsBehindCalls>();
}

TEST_CASE("An engine behind virtual calls is told how far to look") {
    const AnyEngine any{EngineWithReach{}};
    const mir::Ray ray{{0, 0, 0}, {0, 0, 1}};
    CHECK(any.ray_caster().closest_hit(ray)->position.z == 100.0f);
    CHECK(any.ray_caster().closest_hit(ray, 3.0f)->position.z == 3.0f);
}

TEST_CASE("Copies of an engine behind virtual calls share what it stands for") {
    const AnyEngine any{EngineWithReach{}};
    const std::vector<AnyEngine> copies{any};
    CHECK(copies.front().visibility().calls == any.visibility().calls);
}
