// SPDX-License-Identifier: MIT
#include "mir/sampling/light_walk.hpp"

#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/glossy_light.hpp"
#include "mir/paths/path_world.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "support/catch.hpp"
#include "support/kd_lab.hpp"

using mir::CookTorrance;
using mir::Vec3;

namespace {

/// A lamp inside a ball of rough glass that is half cloudy.
struct Ball : mirtest::KdLab {
    Ball() : KdLab(ball()) {}

    static mir::Scene ball() {
        mir::Scene s;
        mir::Material glass;
        glass.name = "glass";
        glass.base_color = {0.8f, 0.8f, 0.8f};
        glass.roughness = 0.3f;
        glass.transmission = 0.5f;
        glass.is_thin = false;
        s.place(mir::builtin::sphere("ball", s.add(glass), {0, 0, 0}, 1.0f, 24, 12));
        mir::Material lamp = mir::emitter("lamp", {}, {1, 1, 1});
        lamp.emits_from_both_sides = true;
        s.place(
            mir::builtin::quad("lamp", s.add(lamp), {-0.1f, 0, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f}));
        s.cameras.push_back(mir::Camera::look_at({0, 0.2f, 0}, {1, 1, 1}, {0, 1, 0}, 0.8f));
        return s;
    }
};

}  // namespace

TEST_CASE("inside a rough body chains carry the lobe, and light paths leave it to them") {
    const Ball ball;
    const mir::LightWalk<CookTorrance,
                         decltype(std::declval<const mir::KdTreeScene&>().ray_caster())>
        walk{ball.surfaces.view(), ball.tree.ray_caster()};
    int inside = 0;
    int outside = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        mir::PathNumbers numbers(mir::Sequence::random, 960, mir::Stream::light_path, i);
        mir::Emission light = sample_emission(ball.lights, numbers);
        if (i % 2 == 0) {
            // From outside.
            light.ray = {3.0f * light.ray.direction + Vec3(0, 0.3f, 0), -light.ray.direction};
        }
        mir::LightVertex<CookTorrance> v;
        if (!walk.next(light, numbers, v) || v.at.point.material != 0) continue;
        (v.at.point.front ? outside : inside) += 1;
        REQUIRE(v.bsdf.has_lobe() == v.at.point.front);
    }
    CHECK(inside > 50);
    CHECK(outside > 50);
}

TEST_CASE("paths and lobes of VPLs know the inside of a rough body, too") {
    const Ball ball;
    const mir::PathWorld world{ball.geometry,          ball.lights,
                               ball.surfaces,          ball.tree.ray_caster(),
                               ball.tree.visibility(), ball.scene.cameras[0]};
    int seen = 0;
    for (std::uint32_t i = 0; i < 100; ++i) {
        mir::Random random(961, mir::Stream::test, i);
        mir::Path path;
        mir::PathVertex v;
        if (!world.hit_luxel(world.camera.ray(random.next_2d(), 1.0f, {0.5f, 0.5f}), path, v))
            continue;
        if (v.material != 0) continue;
        ++seen;
        const bool front = glm::dot(v.normal, v.position) > 0.0f;
        REQUIRE(world.params(v).has_lobe() == front);
    }
    CHECK(seen > 20);

    mir::InstantRadiosityOptions options;
    options.vpls = 200;
    options.arrivals = true;
    mir::InlineExecutor one;
    const mir::VplRecords records =
        mir::InstantRadiositySampler<
            CookTorrance, decltype(std::declval<const mir::KdTreeScene&>().ray_caster())>(
            {ball.geometry, ball.lights, ball.surfaces, ball.tree.ray_caster()}, options)
            .sample(one);
    const mir::VplLobes<CookTorrance> lobes(records, ball.surfaces, 0.1f);
    int inner = 0;
    for (std::size_t i = 0; i < records.records.size(); ++i) {
        if (records.arrivals[i].material != 0 || records.arrivals[i].is_front) continue;
        ++inner;
        REQUIRE_FALSE(lobes.lobes[i].bsdf.has_lobe());
    }
    CHECK(inner > 20);
}
