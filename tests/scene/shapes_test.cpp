// SPDX-License-Identifier: MIT
#include "mir/scene/shapes.hpp"

#include "support/catch.hpp"
#include "support/mesh_measures.hpp"

namespace {

using mir::Mesh;
using mir::Vec3;
using mirtest::Approx;
using namespace mir::builtin;

}  // namespace

TEST_CASE("a quad's front is where a x b points and its area is |a x b|") {
    const Mesh m = quad("q", 3, {1, 2, 3}, {2, 0, 0}, {1, 3, 0});
    CHECK(m.material == 3);
    CHECK(m.triangles.size() == 2);
    CHECK(mirtest::area(m) == Approx(6.0));
    for (const auto& t : m.triangles) CHECK(mirtest::normal(m, t) == Vec3(0, 0, 1));
}

TEST_CASE("a box is closed, turned outwards and has the volume |a . b x c|") {
    const Mesh m = box("b", 0, {-1, 0, 2}, {2, 0, 0}, {0, 3, 0}, {1, 0, 4});
    CHECK(m.triangles.size() == 12);
    CHECK(mirtest::is_closed(m));
    CHECK(mirtest::volume(m) == Approx(24.0));
}

TEST_CASE("inside_out turns faces and normals") {
    const Mesh room = inside_out(box("b", 0, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
    CHECK(mirtest::is_closed(room));
    CHECK(mirtest::volume(room) == Approx(-1.0));
    const Mesh ball = sphere("s", 0, {0, 0, 0}, 1, 8, 4);
    const Mesh turned = inside_out(ball);
    for (std::size_t i = 0; i < ball.normals.size(); ++i)
        CHECK(turned.normals[i] == -ball.normals[i]);
}

TEST_CASE("a sphere is closed, turned outwards and close to 4 pi r^2 and 4/3 pi r^3") {
    const Vec3 centre(1, -2, 0.5f);
    const Mesh m = sphere("s", 0, centre, 2.0f, 44, 22);
    CHECK(m.triangles.size() == 2 * 44 * 21);
    CHECK(mirtest::is_closed(m, 1e-5f));
    CHECK(mirtest::area(m) == Approx(16 * mirtest::pi).epsilon(0.01));
    CHECK(mirtest::volume(m) == Approx(32.0 / 3 * mirtest::pi).epsilon(0.02));
    for (const auto& t : m.triangles)
        CHECK(glm::dot(mirtest::normal(m, t), m.positions[t[0]] - centre) > 0.0f);
    for (std::size_t i = 0; i < m.positions.size(); ++i) {
        CHECK(glm::length(m.normals[i]) == Approx(1.0f).epsilon(1e-6));
        CHECK(glm::length(m.positions[i] - centre - 2.0f * m.normals[i]) < 1e-6f);
    }
}

TEST_CASE("a disc has exactly the area of the round one and faces its normal") {
    for (std::uint32_t corners : {3u, 7u, 256u}) {
        const Mesh m = disc("d", 0, {1, 1, 1}, {0, -1, 0}, {0, 0, 1}, 1.5f, corners);
        CHECK(m.triangles.size() == corners);
        CHECK(mirtest::area(m) == Approx(2.25 * mirtest::pi).epsilon(1e-5));
        for (const auto& t : m.triangles) CHECK(mirtest::normal(m, t).y == Approx(-1.0f));
        for (Vec3 p : m.positions) CHECK(p.y == Approx(1.0f));
    }
}
