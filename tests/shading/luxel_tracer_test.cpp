// SPDX-License-Identifier: MIT
#include "mir/shading/luxel_tracer.hpp"

#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/for_each_luxel.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/test_sky.hpp"

#include <utility>

namespace {

using mir::Lambert;
using mir::Rgb;
using mir::Vec3;

/// A shining floor under a sky.
struct Floor {
    mir::Scene scene = under_sky();
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<Lambert> surfaces{scene};
    mir::KdTreeScene tree{geometry};

    static mir::Scene under_sky() {
        mir::Scene s;
        mir::Material m = mir::lambertian("floor", {0.5f, 0.5f, 0.5f});
        m.emission = {3, 2, 1};
        s.place(mir::builtin::quad("floor", s.add(m), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
        s.environment = mirtest::test_sky();
        return s;
    }
    [[nodiscard]] auto tracer() const {
        return mir::LuxelTracer{tree.ray_caster(), surfaces.view()};
    }
    [[nodiscard]] auto sky() const { return lights.environment().view(); }
};

const mir::Ray down{{0.2f, 1, 0.3f}, {0, -1, 0}};
const mir::Ray up{{0.2f, 1, 0.3f}, glm::normalize(Vec3(0.3f, 1, 0.2f))};

using Tracer = decltype(std::declval<const Floor&>().tracer());

}  // namespace

TEST_CASE("a camera ray sees the surface that it meets") {
    const Floor floor;
    const mir::SeenLuxel seen = floor.tracer()(down);
    REQUIRE_FALSE(seen.is_background);
    CHECK(seen.ray.direction == down.direction);
    const mir::Hit hit = Tracer::hit(seen);
    CHECK(hit.position == lift(seen.point));
    CHECK(hit.normal == Vec3(0, 1, 0));
    const auto surface = floor.tracer().surface(seen, floor.sky());
    CHECK(surface.wo == Vec3(0, 1, 0));
    CHECK(surface.normal == floor.tracer().normal(seen));
    CHECK(surface.emission == Rgb{3, 2, 1});
    CHECK(surface.bsdf.reflectance == Rgb{0.5f, 0.5f, 0.5f});
}

TEST_CASE("a camera ray that meets nothing sees the background, which emits") {
    const Floor floor;
    const mir::SeenLuxel seen = floor.tracer()(up);
    REQUIRE(seen.is_background);
    CHECK(is_empty(Tracer::hit(seen)));
    const auto surface = floor.tracer().surface(seen, floor.sky());
    CHECK(surface.emission == floor.sky().radiance(up.direction));
    CHECK_FALSE(is_black(surface.emission));
    CHECK(Lambert::is_black(surface.bsdf));
    CHECK(is_black(floor.tracer().surface(seen).emission));
}

TEST_CASE("luxels and the reference see the same of surface and background") {
    const Floor floor;
    mir::CameraRays rays;
    rays.camera = mir::Camera::look_at({0, 0.8f, 2}, {0, 0.4f, 0}, {0, 1, 0}, 0.9f);
    rays.grid = mir::luxel_grid({24, 16}, 1);
    mir::BlockedGBuffer<Lambert::Params> luxels(rays.grid.luxels(), {16, 16});
    mir::InlineExecutor executor;
    fill_gbuffer(luxels, 0, rays, floor.tracer(), floor.sky(), executor);
    const mir::PathTracer<Lambert, decltype(floor.tree.ray_caster()),
                          decltype(floor.tree.visibility())>
        reference({floor.geometry, floor.lights, floor.surfaces, floor.tree.ray_caster(),
                   floor.tree.visibility()},
                  {});
    int background = 0;
    for_each_luxel(luxels, executor,
                   [&](std::uint32_t x, std::uint32_t y, const auto& view, mir::LuxelIndex i) {
                       const auto seen = reference.luxel(rays(x, y));
                       CHECK(view.hit(i).position == seen.hit.position);
                       CHECK(view.hit(i).normal == seen.hit.normal);
                       CHECK(view.surface(i).emission == seen.surface.emission);
                       background += is_empty(seen.hit) ? 1 : 0;
                   });
    CHECK(background > 50);
    CHECK(background < 24 * 16 - 50);
}
