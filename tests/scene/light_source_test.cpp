// SPDX-License-Identifier: MIT
#include "conformance/light_source_suite.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/scene/shapes.hpp"
#include "support/test_sky.hpp"

namespace {

using mir::LightOrigin;
using mir::Rgb;
using mir::Vec3;
using mirtest::Approx;
using mirtest::check_light_source;
using mirtest::LightView;

/// A lamp in the plane y = 2 that shines down, and up too if it has both sides.
struct Lamp {
    mir::Scene scene;
    mir::WorldGeometry geometry;
    mir::LightTable lights;

    explicit Lamp(bool both_sides)
        : scene(with(both_sides)), geometry(scene), lights(scene, geometry) {}

    static mir::Scene with(bool both_sides) {
        mir::Scene s;
        mir::Material m = mir::emitter("lamp", {}, {3, 2, 1});
        m.emits_from_both_sides = both_sides;
        s.place(mir::builtin::quad("lamp", s.add(m), {0, 2, 0}, {1, 0, 0}, {0, 0, 1}));
        return s;
    }
};

}  // namespace

// Each light is one member of a family of three statistical tests at level 1e-3, seeds 1 to 5.

TEST_CASE("a point light is a light source", "[statistical]") {
    const mir::PointLight light{"bulb", {0.3f, 1, 0.2f}, {3, 2, 1}, 4};
    const mir::PointSource source = source_of(light, {});
    check_light_source(source, {source.power(), {0, 0, 0}, {0, 1, 0}, 1});
    CHECK(source.start({}, 0).light_group == 4);
}

TEST_CASE("a spot light is a light source", "[statistical]") {
    const mir::SpotLight light{
        "spot", {0.3f, 1, 0.2f}, glm::normalize(Vec3(-0.2f, -1, 0)), {3, 2, 1}, 0.9f, 0.4f};
    const mir::SpotSource source = source_of(light, {});
    check_light_source(source, {source.power(), {0, 0, 0}, {0, 1, 0}, 2});
}

TEST_CASE("a directional light is a light source", "[statistical]") {
    const mir::DirectionalLight light{"sun", glm::normalize(Vec3(1, -2, 0.5f)), {3, 2, 1}};
    const mir::DirectionalSource source = source_of(light, {{1, 2, 3}, 1.5f});
    check_light_source(source, {source.power(), {0, 0, 0}, {0, 1, 0}, 3});
}

TEST_CASE("an environment is a light source", "[statistical]") {
    const mir::EnvironmentTable sky(mirtest::test_sky());
    const mir::EnvironmentView<mir::Space::host> view = sky.view();
    const mir::EnvironmentSource<mir::Space::host> source{{{{1, 2, 3}, 1.5f}}, view};
    check_light_source(source, {source.power(), {0, 0, 0}, {0, 1, 0}, 4});
}

TEST_CASE("an emissive triangle is a light source on each side that shines", "[statistical]") {
    const bool both_sides = GENERATE(false, true);
    const float height = GENERATE(0.0f, 4.0f);
    const Lamp lamp(both_sides);
    const mir::LampView<mir::Space::host> view = lamp.lights.lamps().view();
    const mir::GeometryView<mir::Space::host> geometry = lamp.geometry.view();
    const mir::LampSource<mir::Space::host> source{view, geometry, 1};
    const Vec3 front = view.lamp_triangles[1].normal;
    if (!both_sides && (front.y > 0.0f) != (height > 2.0f)) return;
    check_light_source(source, {lamp.lights.lamps().powers()[1],
                                {0.5f, height, 0.5f},
                                {0, height < 2.0f ? 1.0f : -1.0f, 0},
                                5});
}

TEST_CASE("light from outside enters through the disc of the bounding sphere") {
    const mir::BoundingSphere sphere{{1, 2, 3}, 1.5f};
    const Vec3 w = glm::normalize(Vec3(1, -2, 0.5f));
    mir::Random random(6, mir::Stream::test, 0);
    for (int i = 0; i < 200; ++i) {
        const mir::Ray ray = sphere.ray(w, random.next_2d());
        CHECK(ray.direction == w);
        const Vec3 from_centre = ray.origin - sphere.centre;
        const float along = glm::dot(from_centre, w);
        CHECK(along == Approx(-3.0f));
        CHECK(glm::length(from_centre - along * w) < 1.5001f);
        const Vec3 outside = sphere.outside(sphere.centre, w);
        CHECK(glm::length(outside - sphere.centre) == Approx(6.0f));
    }
}

TEST_CASE("a table dispatches each light to the source that it is") {
    mir::Scene scene = Lamp::with(true);
    scene.point_lights.push_back({"bulb", {0, 1, 0}, {1, 1, 1}, 1});
    scene.spot_lights.push_back({"spot", {0, 1, 0}, {0, -1, 0}, {1, 1, 1}, 0.9f, 0.8f, 2});
    scene.directional_lights.push_back({"sun", {0, -1, 0}, {1, 1, 1}, 3});
    scene.environment = mirtest::constant_sky({1, 1, 1});
    scene.environment->light_group = 4;
    const mir::WorldGeometry geometry(scene);
    const mir::LightTable lights(scene, geometry);
    struct Known {
        LightOrigin origin;
        bool has_extent;
        std::uint16_t group;
    };
    const Known wanted[] = {{LightOrigin::surface, true, 0},  {LightOrigin::surface, true, 0},
                            {LightOrigin::place, false, 1},   {LightOrigin::place, false, 2},
                            {LightOrigin::outside, false, 3}, {LightOrigin::outside, true, 4}};
    for (std::uint32_t light = 0; light < std::size(wanted); ++light) {
        const Known found = lights.visit(light, [](const auto& source) {
            return Known{source.origin, source.has_extent,
                         source.start({0.3f, 0.3f}, 0.0f).light_group};
        });
        CAPTURE(light);
        CHECK(found.origin == wanted[light].origin);
        CHECK(found.has_extent == wanted[light].has_extent);
        CHECK(found.group == wanted[light].group);
    }
}
