// SPDX-License-Identifier: MIT
#include "mir/scene/framing.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

using mir::Vec3;

namespace {

mir::Bounds box(Vec3 low, Vec3 high) {
    mir::Bounds bounds;
    bounds.add(low);
    bounds.add(high);
    return bounds;
}

}  // namespace

TEST_CASE("a framing camera sees every corner of the box, whatever its shape and the image's") {
    const float aspect = GENERATE(0.2f, 0.5625f, 1.0f, 1.7778f, 4.0f);
    const auto bounds = GENERATE(box({-1, -1, -1}, {1, 1, 1}), box({0, 0, 0}, {100, 1, 0}),
                                 box({-1e-6f, 0, 0}, {1e-6f, 1e-7f, 1e-6f}),
                                 box({1000, 1000, 1000}, {1001, 1003, 1002}),
                                 box({-1e6f, -1e6f, -1e3f}, {1e6f, 1e6f, 1e3f}));
    const mir::Camera camera = mir::frame_bounds(bounds, aspect);
    const float half = std::tan(0.5f * camera.vertical_fov);
    float widest = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p((corner & 1) != 0 ? bounds.low.x : bounds.high.x,
                     (corner & 2) != 0 ? bounds.low.y : bounds.high.y,
                     (corner & 4) != 0 ? bounds.low.z : bounds.high.z);
        const float depth = camera.depth(p);
        REQUIRE(depth > 0.0f);
        const float x = std::fabs(glm::dot(p - camera.position, camera.right)) / depth;
        const float y = std::fabs(glm::dot(p - camera.position, camera.up)) / depth;
        CHECK(x <= half * aspect);
        CHECK(y <= half);
        widest = std::max(widest, std::max(x / (half * aspect), y / half));
    }
    CHECK(widest > 0.2f);
    CHECK(glm::length(camera.position - camera.focus_distance * camera.back - bounds.centre()) <=
          1e-3f * bounds.diagonal());
}

TEST_CASE("a point and an empty box are framed too") {
    const mir::Camera at_point = mir::frame_bounds(box({1, 2, 3}, {1, 2, 3}));
    CHECK(at_point.depth({1, 2, 3}) > 0.5f);
    const mir::Camera at_nothing = mir::frame_bounds({});
    CHECK(mir::is_finite(at_nothing.position));
    CHECK(at_nothing.depth({0, 0, 0}) > 0.5f);
}

TEST_CASE("an aspect ratio that is no positive number is refused") {
    CHECK_THROWS_AS(mir::frame_bounds({}, 0.0f), mir::Error);
    CHECK_THROWS_AS(mir::frame_bounds({}, std::numeric_limits<float>::quiet_NaN()), mir::Error);
}
