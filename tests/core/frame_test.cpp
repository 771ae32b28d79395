// SPDX-License-Identifier: MIT
#include "mir/core/frame.hpp"

#include "mir/core/random.hpp"
#include "mir/core/warp.hpp"
#include "support/catch.hpp"

#include <vector>

namespace {

std::vector<mir::Vec3> normals() {
    std::vector<mir::Vec3> list = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},    {0, -1, 0},
                                   {0, 0, 1}, {0, 0, -1}, {0, 0, -1.0f}};
    // Close to the pole at which naive constructions break, from both sides.
    for (float tilt : {1e-3f, 1e-5f, 1e-7f})
        for (float z : {1.0f, -1.0f}) list.push_back(glm::normalize(mir::Vec3(tilt, -tilt, z)));
    list.push_back(glm::normalize(mir::Vec3(1.0f, 2.0f, -0.0f)));
    mir::Random random(3, mir::Stream::test, 0);
    for (int i = 0; i < 1000; ++i) list.push_back(mir::square_to_sphere(random.next_2d()));
    return list;
}

}  // namespace

TEST_CASE("A frame is right-handed and orthonormal around every normal") {
    for (const mir::Vec3 n : normals()) {
        const mir::Frame f = mir::Frame::around(n);
        CAPTURE(n.x, n.y, n.z);
        REQUIRE(f.normal == n);
        REQUIRE(glm::length(f.tangent) == mirtest::Approx(1.0f).epsilon(1e-5));
        REQUIRE(glm::length(f.bitangent) == mirtest::Approx(1.0f).epsilon(1e-5));
        REQUIRE(glm::dot(f.tangent, f.bitangent) == mirtest::Approx(0.0f).margin(1e-5));
        REQUIRE(glm::dot(f.tangent, n) == mirtest::Approx(0.0f).margin(1e-5));
        REQUIRE(glm::dot(f.bitangent, n) == mirtest::Approx(0.0f).margin(1e-5));
        REQUIRE(glm::dot(glm::cross(f.tangent, f.bitangent), n) > 0.99f);
    }
}

TEST_CASE("to_local undoes to_world") {
    for (const mir::Vec3 n : normals()) {
        const mir::Frame f = mir::Frame::around(n);
        const mir::Vec3 local(0.3f, -0.2f, 0.9f);
        REQUIRE(glm::length(f.to_local(f.to_world(local)) - local) < 1e-5f);
        REQUIRE(glm::length(f.to_world({0, 0, 1}) - n) < 1e-6f);
    }
}
