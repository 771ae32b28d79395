// SPDX-License-Identifier: MIT
#include "scenes/sheet.hpp"
#include "scenes/tube.hpp"
#include "support/catch.hpp"
#include "support/mesh_measures.hpp"

namespace {

using mir::Mat4;
using mir::Mesh;
using mir::Vec2;
using mir::Vec3;
using mirtest::Approx;
using namespace mir::builtin;

/// Normals are unit and on the front side of each triangle that has them.
void check_normals(const Mesh& m) {
    REQUIRE(m.normals.size() == m.positions.size());
    bool unit = true;
    bool in_front = true;
    for (const Vec3 n : m.normals) unit = unit && std::fabs(glm::length(n) - 1.0f) < 1e-5f;
    for (const auto& t : m.triangles)
        for (const std::uint32_t v : t)
            in_front = in_front && glm::dot(mirtest::normal(m, t), m.normals[v]) > 0.0f;
    CHECK(unit);
    CHECK(in_front);
}

/// Flat grid of 5 x 3 points over [0, 2] x [0, 1] whose front is +z: rows along x, columns along y.
SurfaceGrid flat_grid() {
    SurfaceGrid g{3, 5, false, {}};
    for (std::uint32_t r = 0; r < g.rows; ++r)
        for (std::uint32_t c = 0; c < g.columns; ++c)
            g.points.emplace_back(0.5f * static_cast<float>(r), 0.5f * static_cast<float>(c), 0.0f);
    return g;
}

/// Cylinder of radius 1 and height 2 about y, front outside.
SurfaceGrid loop_grid() {
    SurfaceGrid g{96, 4, true, {}};
    for (std::uint32_t r = 0; r < g.rows; ++r)
        for (std::uint32_t c = 0; c < g.columns; ++c) {
            const float phi = 2.0f * mir::pi * static_cast<float>(c) / 96.0f;
            g.points.emplace_back(std::cos(phi), 2.0f * static_cast<float>(r) / 3.0f,
                                  std::sin(phi));
        }
    return g;
}

}  // namespace

TEST_CASE("a cushion is closed, turned outwards and fills more than its ellipsoid") {
    const Mesh m = cushion("c", 2, placed({1, 2, 3}, {4, 5, 6}, 0.3f), 48, 24);
    CHECK(m.material == 2);
    CHECK(m.triangles.size() == 2 * 48 * 23);
    CHECK(mirtest::is_closed(m, 1e-5f));
    CHECK(mirtest::volume(m) > 4.0 / 3 * mirtest::pi * 6);
    CHECK(mirtest::volume(m) < 8.0 * 6);
    check_normals(m);
    Vec3 sum(0);
    for (const Vec3 p : m.positions) sum += p;
    CHECK(glm::length(sum / static_cast<float>(m.positions.size()) - Vec3(4, 5, 6)) < 1e-4f);
}

TEST_CASE("a ring is closed and has the volume and area of a torus") {
    const Mesh m = ring("r", 0, 2.0f, 0.5f, 128, 64);
    CHECK(mirtest::is_closed(m));
    CHECK(mirtest::volume(m) == Approx(2 * mirtest::pi * mirtest::pi * 2 * 0.25).epsilon(0.01));
    CHECK(mirtest::area(m) == Approx(4 * mirtest::pi * mirtest::pi * 2 * 0.5).epsilon(0.01));
    check_normals(m);
    for (const Vec3 p : m.positions) CHECK(std::fabs(p.x) <= 0.5f);
}

TEST_CASE("a bent tube is closed, ends included, and as thick as asked for") {
    Mesh m = empty_mesh("t", 0);
    const std::array<Vec3, 4> line{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0.3f, 2, 0),
                                   Vec3(0.3f, 3, 1)};
    add_tube(m, line, 0.05f, 9);
    CHECK(m.triangles.size() == 2 * 9 * 4 - 4);
    CHECK(mirtest::is_closed(m));
    CHECK(mirtest::volume(m) > 0.0);
    check_normals(m);
    for (std::size_t v = 0; v < 4 * 9; ++v)
        CHECK(glm::length(m.positions[v] - line[v / 9]) == Approx(0.05f).epsilon(1e-4));
}

TEST_CASE("a straight tube has the volume of its prism along any direction") {
    for (const Vec3 d : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1), Vec3(1, 1, 1)}) {
        const Mesh m = tube("t", 0, {Vec3(1, 2, 3), Vec3(1, 2, 3) + d}, 0.1f, 6);
        CHECK(mirtest::is_closed(m));
        const double section = 1.5 * std::sqrt(3.0) * 0.01;
        CHECK(mirtest::volume(m) == Approx(section * glm::length(d)).epsilon(1e-4));
        check_normals(m);
    }
}

TEST_CASE("a flat sheet is a closed plate behind its grid") {
    for (const float inset : {0.0f, 0.25f}) {
        const Mesh m = sheet("s", 7, flat_grid(), 0.1f, inset);
        CHECK(m.material == 7);
        CHECK(mirtest::is_closed(m));
        CHECK(mirtest::volume(m) == Approx(2 * 0.1));
        CHECK(mirtest::area(m) == Approx(2 * 2 + 2 * 3 * 0.1));
        check_normals(m);
        for (const Vec3 p : m.positions)
            CHECK(std::fabs(p.z + inset + 0.05f) == Approx(0.05f).epsilon(1e-4));
    }
}

TEST_CASE("a sheet that is a loop is a closed pipe") {
    const Mesh m = sheet("s", 0, loop_grid(), 0.2f);
    CHECK(mirtest::is_closed(m));
    CHECK(mirtest::volume(m) == Approx(mirtest::pi * (1 - 0.64) * 2).epsilon(0.01));
    check_normals(m);
}

TEST_CASE("a mirrored mesh keeps its front outside") {
    const Mesh m = cushion("c", 0, placed({1, 2, 3}, {4, 5, 6}), 16, 8);
    const Mesh other = mirrored(m);
    CHECK(mirtest::volume(other) == Approx(mirtest::volume(m)));
    check_normals(other);
    CHECK(other.positions[5].x == -m.positions[5].x);
}

TEST_CASE("parts that are joined stay what they were") {
    const Mesh a = moved(cushion("a", 0, placed({1, 1, 1}, {0, 0, 0}), 12, 6), {5, 0, 0});
    const Mesh b = ring("b", 0, 2.0f, 0.5f, 16, 8);
    const Mesh both = joined("both", 3, {a, b});
    CHECK(both.material == 3);
    CHECK(mirtest::volume(both) == Approx(mirtest::volume(a) + mirtest::volume(b)));
    CHECK(mirtest::is_closed(both));
    check_normals(both);
}
