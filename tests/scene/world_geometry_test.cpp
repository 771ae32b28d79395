// SPDX-License-Identifier: MIT
#include "mir/scene/world_geometry.hpp"

#include "mir/scene/shapes.hpp"
#include "support/backwards_executor.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <limits>

namespace {

using mir::Mat4;
using mir::Mesh;
using mir::Scene;
using mir::SurfacePoint;
using mir::Vec2;
using mir::Vec3;
using mir::Vec4;
using mir::WorldGeometry;
using mirtest::Approx;
namespace builtin = mir::builtin;

const float infinity = std::numeric_limits<float>::infinity();

Mat4 columns(Vec3 x, Vec3 y, Vec3 z, Vec3 origin = Vec3(0)) {
    return {Vec4(x, 0), Vec4(y, 0), Vec4(z, 0), Vec4(origin, 1)};
}
Scene with(Mesh mesh, const Mat4& to_world = Mat4(1.0f)) {
    Scene s;
    s.add({});
    s.place(std::move(mesh), to_world);
    return s;
}
Mesh square() { return builtin::quad("square", 0, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}); }
Mesh ball() { return builtin::sphere("ball", 0, {0, 0, 0}, 1.0f, 16, 8); }

void check_refused(const Scene& scene, const std::string& reason, const mir::Limits& limits = {},
                   mir::ErrorCode code = mir::ErrorCode::invalid_input) {
    try {
        const WorldGeometry geometry(scene, limits);
        FAIL("no error for: " << reason);
    } catch (const mir::Error& e) {
        CAPTURE(e.what(), reason);
        CHECK(e.code() == code);
        CHECK(std::string(e.what()).find(reason) != std::string::npos);
    }
}

/// Point of each triangle's middle, looked at along -front normal.
SurfacePoint middle(const WorldGeometry& g, std::uint32_t t) {
    return g.surface_point(t, Vec2(1.0f / 3), -g.front_normal(t));
}

}  // namespace

TEST_CASE("each instance brings the triangles of its mesh to its place") {
    Scene s = with(square());
    s.add({});
    Mesh other = builtin::quad("other", 1, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    s.place(other, columns({2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {10, 0, 0}));
    s.instances.push_back({0, columns({0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, 5})});
    const WorldGeometry g(s);
    REQUIRE(g.triangles().size() == 6);
    CHECK(g.positions().size() == 12);
    CHECK((g.material_of(1) == 0 && g.material_of(2) == 1 && g.material_of(5) == 0));
    CHECK(g.corner(2, 0) == Vec3(10, 0, 0));
    CHECK(g.area(2) == Approx(2.0f));
    CHECK(g.front_normal(2) == Vec3(0, 1, 0));
    CHECK(g.corner(4, 1) == Vec3(0, 1, 5));
    CHECK(g.front_normal(4) == Vec3(0, 0, 1));
    CHECK(g.bounds().low == Vec3(-1, 0, 0));
    CHECK(g.bounds().high == Vec3(12, 1, 5));
}

TEST_CASE("a mirrored or stretched instance keeps its front outside and its normals there") {
    const Mat4 placement = GENERATE(columns({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}),
                                    columns({0, 2, 0}, {3, 0, 0}, {0, 0, 0.5f}, {4, 5, 6}),
                                    columns({1, 0, 0}, {0, -1e-3f, 0}, {0, 0, 1}),
                                    columns({-2, 0, 0}, {0, -1, 0}, {0, 0, -5}, {1, 0, 0}),
                                    columns({5, 0, 0}, {0, 1, 0}, {2, 0, 1}));
    const WorldGeometry g(with(ball(), placement));
    const Vec3 centre(placement[3]);
    for (std::uint32_t t = 0; t < g.triangles().size(); ++t) {
        const SurfacePoint p = middle(g, t);
        CHECK(p.front);
        CHECK(glm::dot(g.front_normal(t), p.position - centre) > 0.0f);
        CHECK(glm::dot(p.shading_normal, p.geometric_normal) > 0.0f);
        CHECK(glm::length(p.shading_normal) == Approx(1.0f));
    }
}

TEST_CASE("normals are carried by the inverse transpose, mirrored or not") {
    // The true normal of an ellipsoid x = A n is A^-T n.
    const mir::Mat3 a({2, 0.5f, 0}, {0, -1, 0}, {0, 0.3f, 4});
    const WorldGeometry g(with(ball(), Mat4(a)));
    const Mesh mesh = ball();
    for (std::uint32_t t = 0; t < g.triangles().size(); t += 7) {
        const SurfacePoint p = g.surface_point(t, {0, 0}, -g.front_normal(t));
        const Vec3 n = glm::inverse(a) * g.corner(t, 0);
        const Vec3 expected = glm::normalize(glm::transpose(glm::inverse(a)) * n);
        if (p.shading_normal == p.geometric_normal) continue;
        CHECK(glm::length(p.shading_normal - expected) < 1e-5f);
    }
}

TEST_CASE("the scale of an instance changes no digit of its normals and no side") {
    const float scale = GENERATE(0x1p-50f, 0x1p-20f, 0x1p20f, 0x1p50f);
    CAPTURE(scale);
    const mir::Mat3 a({-2, 0.5f, 0}, {0, 1, 0}, {0, 0.3f, 4});
    const WorldGeometry home(with(ball(), Mat4(a)));
    const WorldGeometry scaled(with(ball(), Mat4(scale * a)));
    CHECK(std::equal(home.normals().begin(), home.normals().end(), scaled.normals().begin(),
                     scaled.normals().end()));
    CHECK(std::equal(home.triangles().begin(), home.triangles().end(), scaled.triangles().begin(),
                     scaled.triangles().end()));
}

TEST_CASE("triangles without area are dropped and counted, flattened instances too") {
    Mesh m = square();
    m.triangles.push_back({0, 0, 1});
    m.triangles.push_back({2, 2, 2});
    m.positions.push_back({0.5f, 0, 0});
    m.triangles.push_back({0, 4, 1});
    const WorldGeometry g(with(m));
    CHECK(g.triangles().size() == 2);
    CHECK(g.dropped_triangles() == 3);
    const WorldGeometry flat(with(ball(), columns({1, 0, 0}, {0, 1, 0}, {0, 0, 0})));
    CHECK(flat.triangles().size() + flat.dropped_triangles() == ball().triangles.size());
    const WorldGeometry line(with(ball(), columns({1, 0, 0}, {0, 0, 0}, {0, 0, 0})));
    CHECK(line.triangles().empty());
    CHECK(line.dropped_triangles() == ball().triangles.size());
}

TEST_CASE("geometry is the same in any number of threads, and gaps between parts are closed") {
    // Parts of 8192: a fifth of the triangles has no area, one part keeps none.
    Mesh fine = builtin::sphere("fine", 0, {0, 0, 0}, 1.0f, 128, 96);
    const std::size_t with_area = fine.triangles.size();
    for (std::size_t i = 0; i < with_area; i += 4) fine.triangles[i] = {3, 3, 4};
    Mesh flat = fine;
    flat.triangles.assign(9000, {1, 1, 1});
    Scene s = with(fine, columns({1, 0, 0}, {0, -2, 0}, {0, 0, 1}));
    s.place(flat);
    s.place(fine, columns({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {5, 0, 0}));
    const WorldGeometry one(s);
    mirtest::BackwardsExecutor executor{3};
    const WorldGeometry many(s, {}, executor);
    CHECK(std::ranges::equal(one.positions(), many.positions()));
    CHECK(std::ranges::equal(one.normals(), many.normals()));
    CHECK(std::ranges::equal(one.triangles(), many.triangles()));
    CHECK(std::ranges::equal(one.materials(), many.materials()));
    CHECK(one.bounds().low == many.bounds().low);
    CHECK(one.bounds().high == many.bounds().high);
    CHECK(one.dropped_triangles() == many.dropped_triangles());
    REQUIRE(one.dropped_triangles() >= 9000 + with_area / 2);
    // Each triangle that is left is that of its mesh, in order.
    std::size_t next = 0;
    std::uint32_t first_vertex = 0;
    for (const mir::Instance& instance : s.instances) {
        const Mesh& mesh = s.meshes[instance.mesh];
        const bool mirrored = glm::determinant(mir::Mat3(instance.to_world)) < 0.0f;
        for (mir::TriangleIndices t : mesh.triangles) {
            if (mirrored) std::swap(t[1], t[2]);
            for (std::uint32_t& v : t) v += first_vertex;
            if (next < one.triangles().size() && one.triangles()[next] == t) ++next;
        }
        first_vertex += static_cast<std::uint32_t>(mesh.positions.size());
    }
    CHECK(next == one.triangles().size());
}

TEST_CASE("an empty scene has no triangles, no bounds and no offset") {
    const WorldGeometry g(Scene{});
    CHECK(g.triangles().empty());
    CHECK(g.bounds().empty());
    CHECK(g.bounds().diagonal() == 0.0f);
    CHECK(g.ray_offset() == 0.0f);
}

TEST_CASE("broken scenes are refused with mesh, reason and remedy") {
    Scene s = with(square());
    s.meshes[0].material = 7;
    check_refused(s, "mesh 'square': material 7 does not exist");
    s = with(square());
    s.meshes[0].triangles[1] = {0, 1, 4};
    check_refused(s, "triangle 1 uses vertex 4 of 4");
    s = with(square());
    s.meshes[0].normals.resize(3);
    check_refused(s, "3 normals for 4 positions");
    s = with(square());
    s.instances[0].mesh = 1;
    check_refused(s, "an instance names mesh 1");
    for (float bad : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
        s = with(square());
        s.meshes[0].positions[2].y = bad;
        check_refused(s, "position 2 is not finite");
        s = with(square());
        s.instances[0].to_world[3][1] = bad;
        check_refused(s, "places it at infinity");
    }
    check_refused(with(builtin::quad("far", 0, {0, 0, 0}, {1e30f, 0, 0}, {0, 1, 0}),
                       columns({1e30f, 0, 0}, {0, 1, 0}, {0, 0, 1})),
                  "mesh 'far': an instance places it at infinity");
}

TEST_CASE("limits are checked before anything is placed") {
    Scene s = with(square());
    for (int i = 0; i < 9; ++i) s.instances.push_back({0});
    mir::Limits limits;
    limits.triangles = 20;
    limits.vertices = 40;
    CHECK(WorldGeometry(s, limits).triangles().size() == 20);
    limits.triangles = 19;
    const auto exceeded = mir::ErrorCode::limit_exceeded;
    check_refused(s, "20 triangles were asked for", limits, exceeded);
    limits.triangles = 20;
    limits.vertices = 39;
    check_refused(s, "Limits::vertices allows 39", limits, exceeded);
}

TEST_CASE("the ray offset grows with the scene and with its distance from the origin") {
    const float one = WorldGeometry(with(ball())).ray_offset();
    CHECK(one == Approx(0x1p-16));
    for (float s : {1e-3f, 1e3f}) {
        const WorldGeometry scaled(with(ball(), columns({s, 0, 0}, {0, s, 0}, {0, 0, s})));
        CHECK(scaled.ray_offset() == Approx(s * one));
    }
    const WorldGeometry far(with(ball(), columns({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -999, 0})));
    CHECK(far.ray_offset() == Approx(2 * 0x1p-14));
    const WorldGeometry near(with(ball(), columns({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -9, 0})));
    CHECK(near.ray_offset() == Approx(2 * 0x1p-14));
    // Lifting moves a point off its surface even where coordinates are largest.
    for (std::uint32_t t = 0; t < far.triangles().size(); ++t) {
        const SurfacePoint p = middle(far, t);
        const Vec3 up = mir::lift(p);
        CHECK(glm::dot(up - far.corner(t, 0), p.geometric_normal) > 0.0f);
        CHECK(glm::length(up - p.position) == Approx(mir::least_offset(p.position)).epsilon(0.05));
    }
}

TEST_CASE("a surface point turns its normals to the side that is looked at") {
    const WorldGeometry g(with(square()));
    const SurfacePoint front = g.surface_point(0, {0.25f, 0.5f}, {0, 0, -1});
    CHECK(front.front);
    CHECK(front.position == Vec3(0.75f, 0.5f, 0));  // corners (0,0) (1,0) (1,1)
    CHECK(front.geometric_normal == Vec3(0, 0, 1));
    CHECK(front.shading_normal == Vec3(0, 0, 1));
    CHECK(front.barycentrics == Vec2(0.25f, 0.5f));
    CHECK(front.triangle == 0);
    const SurfacePoint back = g.surface_point(1, {0.25f, 0.5f}, {0, 0, 1});
    CHECK_FALSE(back.front);
    CHECK(back.geometric_normal == Vec3(0, 0, -1));
    CHECK(back.shading_normal == Vec3(0, 0, -1));
    CHECK(back.triangle == 1);
}

TEST_CASE("shading normals are interpolated, on the viewer's side, wherever they are seen from") {
    Mesh m;
    m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    m.normals = {glm::normalize(Vec3(1, 0, 1)), glm::normalize(Vec3(-1, 0, 1)), {0, 0, 1}};
    m.triangles = {{0, 1, 2}};
    const WorldGeometry g(with(m));
    const Vec3 down(0, 0, -1);
    CHECK(glm::length(g.surface_point(0, {0, 0}, down).shading_normal - m.normals[0]) < 1e-6f);
    CHECK(g.surface_point(0, {0.5f, 0}, down).shading_normal == Vec3(0, 0, 1));
    CHECK(glm::length(g.surface_point(0, {0, 0}, -down).shading_normal + m.normals[0]) < 1e-6f);
    // From the side that the normal of corner 0 turns away from.
    const Vec3 grazing = glm::normalize(Vec3(1, 0, -0.5f));
    CHECK(g.surface_point(0, {0, 0}, grazing).shading_normal ==
          g.surface_point(0, {0, 0}, down).shading_normal);
}

TEST_CASE("normals that cancel or are missing fall back to the geometric one") {
    Mesh m = square();
    m.normals.assign(4, Vec3(0));
    CHECK(middle(WorldGeometry(with(m)), 0).shading_normal == Vec3(0, 0, 1));
    m.normals.assign(4, Vec3(std::numeric_limits<float>::quiet_NaN()));
    CHECK(middle(WorldGeometry(with(m)), 0).shading_normal == Vec3(0, 0, 1));
    m.normals.assign(4, Vec3(0, infinity, 0));
    CHECK(middle(WorldGeometry(with(m)), 0).shading_normal == Vec3(0, 0, 1));
}

TEST_CASE("areas and normals stay right for very small and very large triangles") {
    const float s = GENERATE(1e-6f, 1e-3f, 1e6f, 1e9f);
    const WorldGeometry g(with(square(), columns({s, 0, 0}, {0, s, 0}, {0, 0, s})));
    REQUIRE(g.triangles().size() == 2);
    CHECK(g.area(0) / (s * s) == Approx(0.5f));
    CHECK(glm::length(g.front_normal(1) - Vec3(0, 0, 1)) < 1e-6f);
}
