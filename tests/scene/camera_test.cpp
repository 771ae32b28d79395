// SPDX-License-Identifier: MIT
#include "mir/scene/camera.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

namespace {

using mir::Camera;
using mir::Ray;
using mir::Vec2;
using mir::Vec3;
using mirtest::Approx;

constexpr float aspect = 16.0f / 9.0f;

Camera tilted() { return Camera::look_at({1, 2, 3}, {-2, 0, 1}, {0, 1, 0}, 0.9f); }

/// Film position to which the pinhole camera projects a point.
Vec2 project(const Camera& c, Vec3 point) {
    const Vec3 d = point - c.position;
    const float half = std::tan(0.5f * c.vertical_fov);
    const float x = glm::dot(d, c.right) / (c.depth(point) * half * aspect);
    const float y = glm::dot(d, c.up) / (c.depth(point) * half);
    return {0.5f + 0.5f * x, 0.5f - 0.5f * y};
}

Vec3 where_depth_is(const Camera& c, const Ray& ray, float depth) {
    return ray.origin + ray.direction * (depth / -glm::dot(ray.direction, c.back));
}

}  // namespace

TEST_CASE("look_at makes a right-handed frame that looks at its target") {
    const Camera c = tilted();
    CHECK(glm::length(c.right) == Approx(1.0f));
    CHECK(glm::length(c.up) == Approx(1.0f));
    CHECK(glm::dot(c.right, c.up) == Approx(0.0f).margin(1e-6));
    CHECK(glm::length(glm::cross(c.right, c.up) - c.back) < 1e-6f);
    CHECK(c.up.y > 0.0f);
    const Ray centre = c.ray({0.5f, 0.5f}, aspect, {0.3f, 0.8f});
    CHECK(glm::length(centre.direction - glm::normalize(Vec3(-3, -2, -2))) < 1e-6f);
    CHECK(centre.origin == c.position);
}

TEST_CASE("a point is projected to where rays to it pass the film, and the film has area one") {
    for (const float lens : {0.0f, 0.2f}) {
        Camera c = tilted();
        c.lens_radius = lens;
        c.focus_distance = 2.5f;
        double film = 0.0;
        for (std::uint64_t i = 0; i < 4096; ++i) {
            mir::Random random(70, mir::Stream::test, i);
            const Vec2 at = random.next_2d();
            const Vec2 on_lens = random.next_2d();
            const Ray ray = c.ray(at, aspect, on_lens);
            const mir::FilmPoint seen =
                c.optics().project(ray.origin + 3.7f * ray.direction, aspect, on_lens);
            REQUIRE(seen.is_on_film());
            REQUIRE(seen.film.x == Approx(at.x).margin(1e-5));
            REQUIRE(seen.film.y == Approx(at.y).margin(1e-5));
            REQUIRE(glm::length(seen.from - ray.origin) < 1e-6f);
            // The mean of dω / d film over the film, from a pinhole, is the picture's solid angle.
            film += 1.0 / static_cast<double>(seen.per_steradian) / 4096;
        }
        if (lens > 0.0f) continue;
        const double half = std::tan(0.45);
        const double wide = half * static_cast<double>(aspect);
        const double angle =
            4.0 * std::asin(half * wide / std::sqrt((1 + half * half) * (1 + wide * wide)));
        CHECK(film == Approx(angle).epsilon(0.02));
    }
    CHECK_FALSE(tilted().optics().project({9, 9, 9}, aspect, {}).is_on_film());
}

TEST_CASE("a default camera looks along -z with x to the right and y up") {
    const Camera c;
    const float half = std::tan(0.4f);
    const Ray corner = c.ray({1.0f, 0.0f}, 2.0f, {});
    CHECK(corner.direction.x / -corner.direction.z == Approx(2.0f * half));
    CHECK(corner.direction.y / -corner.direction.z == Approx(half));
}

TEST_CASE("a pinhole's rays are unit vectors that project back to their film position") {
    const Camera c = tilted();
    for (float x : {0.0f, 0.25f, 0.5f, 1.0f})
        for (float y : {0.0f, 0.4f, 1.0f}) {
            const Ray ray = c.ray({x, y}, aspect, {0.5f, 0.5f});
            CHECK(mir::length_squared(ray.direction) == Approx(1.0f).epsilon(1e-6));
            const Vec2 back = project(c, ray.origin + 7.0f * ray.direction);
            CHECK(back.x == Approx(x).margin(1e-5));
            CHECK(back.y == Approx(y).margin(1e-5));
        }
}

TEST_CASE("depth is measured along the viewing direction") {
    const Camera c = tilted();
    CHECK(c.depth(c.position) == 0.0f);
    CHECK(c.depth(c.position - 3.0f * c.back + 5.0f * c.right) == Approx(3.0f).epsilon(1e-5));
    CHECK(c.depth(c.position + c.back) == Approx(-1.0f));
}

TEST_CASE("rays from all points of the lens meet at the focus distance and nowhere else") {
    Camera c = tilted();
    c.lens_radius = 0.2f;
    c.focus_distance = 4.0f;
    Camera pinhole = c;
    pinhole.lens_radius = 0.0f;
    mir::Random random(1, mir::Stream::test, 0);
    for (Vec2 film : {Vec2(0.5f, 0.5f), Vec2(0.0f, 1.0f), Vec2(0.9f, 0.2f)}) {
        const Vec3 focus = where_depth_is(c, pinhole.ray(film, aspect, {}), 4.0f);
        float spread = 0.0f;
        for (int i = 0; i < 200; ++i) {
            const Ray ray = c.ray(film, aspect, random.next_2d());
            CHECK(mir::length_squared(ray.direction) == Approx(1.0f).epsilon(1e-6));
            const float depth = c.depth(focus) - c.depth(ray.origin);
            CHECK(glm::length(where_depth_is(c, ray, depth) - focus) < 1e-5f);
            CHECK(std::fabs(c.depth(ray.origin)) < 1e-6f);
            const Vec3 beyond = where_depth_is(c, ray, 8.0f);
            spread = std::max(spread, glm::length(project(c, beyond) - film));
        }
        CHECK(spread > 0.01f);
    }
}

// H0: points of the lens are uniform over its disc. Chi-square on 12 x 12 cells of (area inside the
// radius, azimuth), level 1 %, seed 131. A lens 2 % too large must be rejected.
TEST_CASE("the lens is sampled uniformly over its area", "[statistical]") {
    Camera c = tilted();
    mirtest::Histogram right(12, 12);
    mirtest::Histogram wrong(12, 12);
    const auto add = [&](mirtest::Histogram& h, float radius, Vec2 u) {
        c.lens_radius = radius;
        const Vec3 d = c.ray({0.2f, 0.7f}, aspect, u).origin - c.position;
        const auto x = static_cast<double>(glm::dot(d, c.right)) / 0.5;
        const auto y = static_cast<double>(glm::dot(d, c.up)) / 0.5;
        h.add((x * x + y * y) * (1 - 1e-5), mirtest::turn(x, y));
    };
    mir::Random random(131, mir::Stream::test, 0);
    for (int i = 0; i < 50'000; ++i) {
        const Vec2 u = random.next_2d();
        add(right, 0.5f, u);
        add(wrong, 0.51f, u);
    }
    const auto uniform = [](double, double) { return 1.0; };
    CHECK(right.against(uniform).p_value > 0.01);
    CHECK(wrong.against(uniform).p_value < 0.01);
}
