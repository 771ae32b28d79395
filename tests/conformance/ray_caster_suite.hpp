// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/referee.hpp"
#include "conformance/worlds.hpp"
#include "mir/concepts/ray_caster.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <thread>
#include <vector>

// The axioms of RayCaster. `Engine` is made from a WorldGeometry and hands out a model with
// ray_caster().

namespace mirtest {

inline std::vector<mir::Ray> random_rays(std::size_t count, std::uint64_t index) {
    mir::Random random = test_random(index);
    std::vector<mir::Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const mir::Vec3 origin = point_in_cube(random);
        rays.push_back({origin, direction(random)});
    }
    return rays;
}

/// Same triangle and same place as the referee's, wherever no edge and no second triangle is near.
template <class Engine>
void ray_caster_agrees_with_brute_force() {
    const World world = triangle_soup(150, 21);
    const Engine engine(world.geometry);
    const auto caster = engine.ray_caster();
    const Referee referee(world.geometry);
    const auto rays = random_rays(20000, 22);
    std::size_t hits = 0;
    std::size_t sure_and_wrong = 0;
    std::size_t different = 0;
    float farthest = 0.0f;
    for (const mir::Ray& ray : rays) {
        const Referee::Closest wanted = referee.closest(ray);
        const auto found = caster.closest_hit(ray);
        hits += found ? 1 : 0;
        const std::uint32_t triangle = found ? found->triangle : Referee::none;
        if (triangle != wanted.triangle) {
            ++different;
            const bool tie = wanted.runner_up - wanted.hit.t < 1e-5;
            if (wanted.margin > 1e-4 && !tie && wanted.hit.t > 1e-5) ++sure_and_wrong;
        } else if (found) {
            const mir::Vec3 place = ray.origin + static_cast<float>(wanted.hit.t) * ray.direction;
            farthest = std::max(farthest, glm::length(found->position - place));
        }
    }
    INFO(hits << " of " << rays.size() << " hit, " << different << " differ");
    CHECK(hits > rays.size() / 10);
    CHECK(hits < rays.size());
    CHECK(sure_and_wrong == 0);
    CHECK(different <= rays.size() / 1000);
    // Below a tenth of a millimetre in a scene of two metres, grazing hits included.
    CHECK(farthest < 1e-4f);
}

/// Normals are unit vectors on the side the ray came from; barycentrics and indices are in range.
template <class Engine>
void ray_caster_fills_in_surface_points() {
    const World world = sphere_in_box();
    const Engine engine(world.geometry);
    const auto caster = engine.ray_caster();
    std::size_t fronts = 0;
    for (const mir::Ray& ray : random_rays(2000, 23)) {
        const auto p = caster.closest_hit(ray);
        REQUIRE(p);
        REQUIRE(p->triangle < world.geometry.triangles().size());
        REQUIRE(p->material == world.geometry.material_of(p->triangle));
        REQUIRE(glm::length(p->geometric_normal) == Approx(1.0f).epsilon(1e-5));
        REQUIRE(glm::length(p->shading_normal) == Approx(1.0f).epsilon(1e-5));
        REQUIRE(glm::dot(p->geometric_normal, ray.direction) <= 0.0f);
        REQUIRE(glm::dot(p->shading_normal, p->geometric_normal) >= 0.0f);
        REQUIRE(p->barycentrics.x >= -1e-5f);
        REQUIRE(p->barycentrics.y >= -1e-5f);
        REQUIRE(p->barycentrics.x + p->barycentrics.y <= 1.0f + 1e-5f);
        const mir::Vec3 front = world.geometry.front_normal(p->triangle);
        REQUIRE(p->front == (glm::dot(front, ray.direction) <= 0.0f));
        fronts += p->front ? 1 : 0;
    }
    CHECK(fronts > 1000);
    CHECK(fronts < 2000);
}

template <class Engine>
void rays_that_leave_the_scene_hit_nothing() {
    const World world = triangle_soup(150, 24);
    const Engine engine(world.geometry);
    const auto caster = engine.ray_caster();
    mir::Random random = test_random(25);
    for (int i = 0; i < 2000; ++i) {
        const mir::Vec3 away = direction(random);
        REQUIRE_FALSE(caster.closest_hit({3.0f * away, away}));
    }
}

template <class Engine>
void ray_caster_may_be_asked_concurrently() {
    const World world = triangle_soup(150, 26);
    const Engine engine(world.geometry);
    const auto caster = engine.ray_caster();
    const auto rays = random_rays(4000, 27);
    const auto ask = [&] {
        std::vector<std::uint32_t> triangles;
        for (const mir::Ray& ray : rays) {
            const auto p = caster.closest_hit(ray);
            triangles.push_back(p ? p->triangle : Referee::none);
        }
        return triangles;
    };
    const auto alone = ask();
    std::vector<std::vector<std::uint32_t>> together(4);
    std::vector<std::thread> threads;
    for (auto& answers : together) threads.emplace_back([&] { answers = ask(); });
    for (std::thread& t : threads) t.join();
    for (const auto& answers : together) CHECK(answers == alone);
}

/// closest_hit() in every bit up to where a ray may stop; and it does stop.
template <class Engine>
void short_rays_find_what_lies_near() {
    const World world = triangle_soup(150, 21);
    const Engine engine(world.geometry);
    const auto caster = engine.ray_caster();
    mir::Random random = test_random(28);
    std::size_t stopped = 0;
    for (const mir::Ray& ray : random_rays(4000, 22)) {
        const auto far = caster.closest_hit(ray);
        const float d = far ? glm::length(far->position - ray.origin) : 1.0f;
        const float reach = d * std::exp2(8.0f * random.next() - 4.0f);
        const auto near = caster.closest_hit(ray, reach);
        if (far && d < 0.999f * reach) {
            REQUIRE(near);
            REQUIRE(near->triangle == far->triangle);
            REQUIRE(near->position == far->position);
        } else if (near) {
            REQUIRE(far);
            REQUIRE(near->triangle == far->triangle);
        } else {
            stopped += far && reach < 0.9f * d ? 1 : 0;
        }
    }
    CHECK(stopped > 300);
}

template <class Engine>
void ray_caster_suite() {
    static_assert(mir::RayCaster<decltype(std::declval<const Engine&>().ray_caster())>);
    SECTION("agrees with brute force") { ray_caster_agrees_with_brute_force<Engine>(); }
    SECTION("fills in surface points") { ray_caster_fills_in_surface_points<Engine>(); }
    SECTION("rays that leave the scene hit nothing") {
        rays_that_leave_the_scene_hit_nothing<Engine>();
    }
    SECTION("may be asked concurrently") { ray_caster_may_be_asked_concurrently<Engine>(); }
    if constexpr (mir::ShortRayCaster<decltype(std::declval<const Engine&>().ray_caster())>)
        SECTION("stops early") { short_rays_find_what_lies_near<Engine>(); }
}

}  // namespace mirtest
