// SPDX-License-Identifier: MIT
#include "mir/scene/geometry_view.hpp"

#include "conformance/stage.hpp"
#include "support/catch.hpp"

#include <type_traits>

using mir::Vec3;

static_assert(std::is_trivially_copyable_v<mir::GeometryView<mir::Space::device>>);
static_assert(std::is_trivially_copyable_v<mir::LuxelRays>);

TEST_CASE("Triangle indices are three words that can be listed and compared") {
    mir::TriangleIndices t{4, 5, 6};
    t[1] = 9;
    CHECK(std::vector<std::uint32_t>(t.begin(), t.end()) == std::vector<std::uint32_t>{4, 9, 6});
    CHECK(t == mir::TriangleIndices{4, 9, 6});
    CHECK_FALSE(t == mir::TriangleIndices{4, 9, 7});
    static_assert(sizeof t == 12);
}

TEST_CASE("A view of a geometry gives the points of the geometry") {
    const mirtest::World world(mirtest::glossy_box());
    const mir::WorldGeometry& g = world.geometry;
    const auto view = g.view();
    CHECK(view.ray_offset == g.ray_offset());
    mir::Random random = mirtest::test_random(3);
    for (std::uint32_t t = 0; t < g.triangles().size(); ++t) {
        CHECK(view.front_normal(t) == g.front_normal(t));
        CHECK(view.materials[t] == g.material_of(t));
        const mir::Vec2 at = mir::square_to_triangle(random.next_2d());
        const Vec3 along = mir::square_to_sphere(random.next_2d());
        const mir::SurfacePoint p = view.surface_point(t, at, along);
        const Vec3 wanted =
            (1.0f - at.x - at.y) * g.corner(t, 0) + at.x * g.corner(t, 1) + at.y * g.corner(t, 2);
        CHECK(glm::length(p.position - wanted) <= 1e-6f);
        CHECK(p.front == (glm::dot(along, g.front_normal(t)) <= 0.0f));
        CHECK(p.geometric_normal == (p.front ? 1.0f : -1.0f) * g.front_normal(t));
        CHECK(p.shading_normal == g.surface_point(t, at, along).shading_normal);
        CHECK((p.triangle == t && p.material == g.material_of(t) && p.barycentrics == at));
    }
}

TEST_CASE("Rays as kernels make them are those of the camera") {
    mir::CameraRays rays;
    rays.camera = mir::Camera::look_at({1, 2, 3}, {0, 0, 0}, {0, 1, 0}, 0.9f);
    rays.camera.lens_radius = GENERATE(0.0f, 0.2f);
    rays.camera.focus_distance = 2.5f;
    rays.grid = mir::luxel_grid({31, 17}, GENERATE(1u, 6u));
    rays.seed = 5;
    const mir::LuxelRays same = rays.luxel_rays();
    for (std::uint32_t y = 0; y < rays.grid.luxels().height; ++y)
        for (std::uint32_t x = 0; x < rays.grid.luxels().width; ++x) {
            mir::Random lens(5, mir::Stream::lens, std::uint64_t{y} * rays.grid.luxels().width + x);
            const mir::Vec2 at = rays.grid.position(x, y, 5);
            const mir::Ray wanted =
                rays.camera.ray({at.x / 31.0f, at.y / 17.0f}, 31.0f / 17.0f, lens.next_2d());
            REQUIRE(same(x, y).origin == wanted.origin);
            REQUIRE(same(x, y).direction == wanted.direction);
        }
}
