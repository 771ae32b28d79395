// SPDX-License-Identifier: MIT
#include "mir/scene/projection.hpp"

#include "support/catch.hpp"

using mir::Camera;
using mir::Vec2;
using mir::Vec3;
using mirtest::Approx;

TEST_CASE("a point on the ray through a film position is projected to that position") {
    const Camera camera = Camera::look_at({1, 2, 3}, {-2, 0, 1}, {0, 1, 0}, 0.9f);
    constexpr float aspect = 1.6f;
    for (const Vec2 film :
         {Vec2{0.5f, 0.5f}, Vec2{0, 0}, Vec2{1, 0.25f}, Vec2{0.1f, 1}, Vec2{-0.3f, 1.4f}}) {
        const mir::Ray ray = camera.ray(film, aspect, {0, 0});
        for (const float t : {0.01f, 1.0f, 300.0f}) {
            const auto seen = mir::project(camera, aspect, ray.origin + t * ray.direction);
            REQUIRE(seen);
            CHECK(seen->x == Approx(film.x).margin(1e-4));
            CHECK(seen->y == Approx(film.y).margin(1e-4));
        }
    }
}

TEST_CASE("points beside and behind the lens plane are not in the picture") {
    const Camera camera;
    CHECK_FALSE(mir::project(camera, 1.0f, camera.position));
    CHECK_FALSE(mir::project(camera, 1.0f, {3, 0, 0}));
    CHECK_FALSE(mir::project(camera, 1.0f, {0, 0, 2}));
    CHECK(mir::project(camera, 1.0f, {0, 0, -2}));
}
