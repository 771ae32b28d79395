// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/referee.hpp"
#include "conformance/worlds.hpp"
#include "mir/concepts/visibility.hpp"
#include "support/catch.hpp"

#include <thread>
#include <vector>

// The axioms of Visibility and PacketVisibility. `Engine` is made from a WorldGeometry and hands
// out a model with visibility().

namespace mirtest {

/// Barycentric margin below which single precision may see a segment either way.
inline constexpr double doubtful_margin = 1e-4;

/// Random segment whose ends lie inside or around the soup.
struct Segment {
    mir::Vec3 a{0};
    mir::Vec3 b{0};
};

inline std::vector<Segment> random_segments(std::size_t count, std::uint64_t index,
                                            float scale = 1.0f, mir::Vec3 move = {0, 0, 0}) {
    mir::Random random = test_random(index);
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < count; ++i) {
        const mir::Vec3 a = point_in_cube(random);
        segments.push_back({move + scale * a, move + scale * point_in_cube(random)});
    }
    return segments;
}

/// Axiom 4: agrees with brute force. Wherever the referee is sure the answers are equal; where it
/// is not, at most one segment in a thousand differs.
template <class Engine>
void visibility_agrees_with_brute_force(float scale, mir::Vec3 move) {
    const World world = triangle_soup(150, 1, scale, move);
    const Engine engine(world.geometry);
    const auto visibility = engine.visibility();
    const Referee referee(world.geometry);
    std::size_t seen = 0;
    std::size_t sure_and_wrong = 0;
    std::size_t different = 0;
    const auto segments = random_segments(20000, 2, scale, move);
    for (const Segment& s : segments) {
        const Referee::Verdict verdict = referee.segment(s.a, s.b);
        const bool visible = visibility.visible(s.a, s.b);
        seen += visible ? 1 : 0;
        if (visible == verdict.visible()) continue;
        ++different;
        if (!verdict.doubtful(doubtful_margin)) ++sure_and_wrong;
    }
    INFO(seen << " of " << segments.size() << " visible, " << different << " differ");
    // A model that always says the same thing must not pass.
    CHECK(seen > segments.size() / 10);
    CHECK(seen < segments.size() * 9 / 10);
    CHECK(sure_and_wrong == 0);
    CHECK(different <= segments.size() / 1000);
}

/// Axiom 1: symmetric. Only segments that graze an edge may differ, at most one in a thousand.
template <class Engine>
void visibility_is_symmetric() {
    const World world = triangle_soup(150, 3);
    const Engine engine(world.geometry);
    const auto visibility = engine.visibility();
    const Referee referee(world.geometry);
    std::size_t different = 0;
    std::size_t sure_and_different = 0;
    const auto segments = random_segments(20000, 4);
    for (const Segment& s : segments) {
        if (visibility.visible(s.a, s.b) == visibility.visible(s.b, s.a)) continue;
        ++different;
        if (!referee.segment(s.a, s.b).doubtful(doubtful_margin)) ++sure_and_different;
    }
    CHECK(different <= segments.size() / 1000);
    CHECK(sure_and_different == 0);
}

/// Axiom 2: points lifted off a surface are not hidden by it, at any scale and place.
template <class Engine>
void lifted_points_are_not_hidden_by_their_own_surface(float scale, mir::Vec3 move) {
    const World world = triangle_soup(100, 5, scale, move);
    const Engine engine(world.geometry);
    const auto visibility = engine.visibility();
    const Referee referee(world.geometry);
    const float offset = world.geometry.ray_offset();
    mir::Random random = test_random(6);
    std::size_t asked = 0;
    std::size_t hidden = 0;
    for (int i = 0; i < 40000; ++i) {
        const mir::SurfacePoint p = random_surface_point(world.geometry, random);
        const mir::SurfacePoint q = random_surface_point(world.geometry, random);
        const mir::Vec3 a = mir::lift(p.position, p.geometric_normal, offset);
        const mir::Vec3 b = mir::lift(q.position, q.geometric_normal, offset);
        const bool facing = glm::dot(b - a, p.geometric_normal) > 0.0f &&
                            glm::dot(a - b, q.geometric_normal) > 0.0f;
        if (!facing) continue;
        // Neighbours that come within the lift of a segment may rightly hide it.
        const auto others = referee.segment(a, b, p.triangle, q.triangle);
        if (!others.visible() || others.doubtful(doubtful_margin)) continue;
        ++asked;
        hidden += visibility.visible(a, b) ? 0 : 1;
    }
    INFO(hidden << " of " << asked << " hidden");
    CHECK(asked > 1000);
    CHECK(hidden == 0);
}

/// Axiom 3: callable from many threads at once.
template <class Engine>
void visibility_may_be_asked_concurrently() {
    const World world = triangle_soup(150, 7);
    const Engine engine(world.geometry);
    const auto visibility = engine.visibility();
    const auto segments = random_segments(4000, 8);
    const auto ask = [&] {
        std::vector<char> answers;
        for (const Segment& s : segments)
            answers.push_back(visibility.visible(s.a, s.b) ? 'y' : 'n');
        return answers;
    };
    const std::vector<char> alone = ask();
    std::vector<std::vector<char>> together(4);
    std::vector<std::thread> threads;
    for (auto& answers : together) threads.emplace_back([&] { answers = ask(); });
    for (std::thread& t : threads) t.join();
    for (const auto& answers : together) CHECK(answers == alone);
}

template <class Engine>
void visibility_suite() {
    static_assert(mir::Visibility<decltype(std::declval<const Engine&>().visibility())>);
    SECTION("agrees with brute force") {
        visibility_agrees_with_brute_force<Engine>(1.0f, {0, 0, 0});
    }
    SECTION("agrees with brute force when small and far away") {
        visibility_agrees_with_brute_force<Engine>(0.01f, {0.5f, -0.2f, 0.1f});
    }
    SECTION("is symmetric") { visibility_is_symmetric<Engine>(); }
    SECTION("lifted points are not hidden by their own surface") {
        const auto [scale, x] = GENERATE(
            table<float, float>({{1.0f, 0.0f}, {1e-3f, 0.0f}, {1e4f, 0.0f}, {1.0f, 100.0f}}));
        INFO("scale " << scale << ", moved by " << x);
        lifted_points_are_not_hidden_by_their_own_surface<Engine>(scale, {x, 0.3f * x, -x});
    }
    SECTION("may be asked concurrently") { visibility_may_be_asked_concurrently<Engine>(); }
}

}  // namespace mirtest
