// SPDX-License-Identifier: MIT
#include "mir/scene/recentre.hpp"

#include "mir/scene/scene_hash.hpp"
#include "mir/scene/world_geometry.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"

#include <cstdint>
#include <limits>
#include <string>

namespace {

using mir::DMat4;
using mir::DVec3;
using mir::Placements;
using mir::Scene;
using mir::Vec3;
using mir::detail::largest_coordinate;

const double no_number = std::numeric_limits<double>::quiet_NaN();

std::string hash(const Scene& scene) { return mir::SceneHash(scene).hex(); }

/// The Cornell box with a light of each kind that has a place.
Scene room() {
    Scene s = mir::builtin::make("cornell-box");
    s.point_lights.push_back({"bulb", {0.25f, 1.5f, 0}, {1, 1, 1}});
    s.spot_lights.emplace_back().position = {-0.5f, 1.75f, 0.125f};
    return s;
}

/// Places of `scene`, moved by `way`.
Placements moved(const Scene& scene, DVec3 way) {
    Placements places = mir::placements_of(scene);
    for (DMat4& m : places.instances) m[3] += glm::dvec4(way, 0.0);
    for (auto* list :
         {&places.lights<mir::PointLight>(), &places.lights<mir::SpotLight>(), &places.cameras})
        for (DVec3& place : *list) place += way;
    return places;
}

/// The scene with its vertices, and all else, moved by `way` in the precision of floats.
Scene with_far_vertices(Scene scene, Vec3 way) {
    for (mir::Mesh& mesh : scene.meshes)
        for (Vec3& p : mesh.positions) p += way;
    for (mir::PointLight& light : scene.point_lights) light.position += way;
    for (mir::SpotLight& light : scene.spot_lights) light.position += way;
    for (mir::Camera& camera : scene.cameras) camera.position += way;
    return scene;
}

/// Largest coordinate by which the vertices of two worlds differ.
double distance(const Scene& a, const Scene& b) {
    const mir::WorldGeometry first(a);
    const mir::WorldGeometry second(b);
    REQUIRE(first.positions().size() == second.positions().size());
    double most = 0.0;
    for (std::size_t i = 0; i < first.positions().size(); ++i)
        most = std::fmax(most, largest_coordinate(DVec3(first.positions()[i]) + a.origin -
                                                  DVec3(second.positions()[i]) - b.origin));
    return most;
}

/// One triangle with legs of `size`, its right angle at `place`.
mir::Mesh triangle(const char* name, Vec3 place, float size) {
    mir::Mesh mesh;
    mesh.name = name;
    mesh.positions = {place, place + Vec3(size, 0, 0), place + Vec3(0, 0, size)};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

}  // namespace

TEST_CASE("a scene near its origin keeps every bit, and no remark is made") {
    for (const auto& entry : mir::builtin::scenes) {
        Scene scene = entry.make();
        const std::string before = hash(scene);
        CAPTURE(entry.name);
        CHECK(mir::recentre(scene).empty());
        CHECK(hash(scene) == before);
        CHECK(scene.origin == DVec3(0.0));
    }
    Scene beside = room();
    for (mir::Instance& i : beside.instances) i.to_world[3].x += 14.0f;
    const std::string before = hash(beside);
    CHECK(mir::recentre(beside).empty());
    CHECK(hash(beside) == before);
}

TEST_CASE("a scene moved far away in double precision comes back with every bit") {
    const Scene near = room();
    for (const DVec3 way : {DVec3(1e3, -1e3, 504), DVec3(0, 0, -1e5), DVec3(1e7, 1e7, -1e7)}) {
        Scene far = near;
        CAPTURE(way.x, way.y, way.z);
        CHECK(mir::recentre(far, moved(near, way)).empty());
        CHECK(hash(far) == hash(near));
        CHECK(far.origin == way);
    }
}

TEST_CASE("a way that is no round number costs no more than rounding near the origin") {
    const Scene near = room();
    const DVec3 way(6378137.3, -4234567.123456789, 1234.56789);
    Scene far = near;
    static_cast<void>(mir::recentre(far, moved(near, way)));
    Scene back = far;
    back.origin -= way;
    CHECK(distance(back, near) < 1e-6);
    CHECK(largest_coordinate(DVec3(far.cameras[0].position) + back.origin -
                             DVec3(near.cameras[0].position)) < 1e-6);
    CHECK(largest_coordinate(DVec3(far.point_lights[0].position) + back.origin -
                             DVec3(near.point_lights[0].position)) < 1e-6);
    CHECK(largest_coordinate(DVec3(far.spot_lights[0].position) + back.origin -
                             DVec3(near.spot_lights[0].position)) < 1e-6);
}

TEST_CASE("a scene that was brought to its origin stays there") {
    Scene scene = room();
    static_cast<void>(mir::recentre(scene, moved(scene, {12345.678, 0, -98765.4})));
    const std::string before = hash(scene);
    const DVec3 origin = scene.origin;
    static_cast<void>(mir::recentre(scene));
    CHECK(hash(scene) == before);
    CHECK(scene.origin == origin);
    for (mir::Instance& i : scene.instances) i.to_world[3].y += 4096.0f;
    static_cast<void>(mir::recentre(scene));
    CHECK(scene.origin == origin + DVec3(0, 4096, 0));
}

TEST_CASE("vertices far from the origin of their mesh lose nothing more than they had lost") {
    const Vec3 way(1e5f, 0, -1e5f);
    const Scene rounded = with_far_vertices(room(), way);
    Scene far = rounded;
    static_cast<void>(mir::recentre(far));
    CHECK(far.origin == DVec3(way));
    // The vertices that a file gives are on the grid of floats at 100 km; relative to a place on
    // that grid they are what they were.
    CHECK(distance(far, rounded) == 0.0);
    CHECK(mir::WorldGeometry(far).bounds().diagonal() < 4.0f);
}

TEST_CASE("far vertices that a turned placement brings home are not rounded far away") {
    Scene scene;
    scene.add({});
    scene.meshes = {triangle("far", {1e5f, 0, 3e5f}, 2.0f), triangle("near", {0, 0, 0}, 2.0f)};
    const double c = std::cos(1.0);
    const double s = std::sin(1.0);
    DMat4 turned(glm::dvec4(c, 0, -s, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(s, 0, c, 0),
                 glm::dvec4(0, 0, 0, 1));
    turned[3] = glm::dvec4(-(glm::dmat3(turned) * DVec3(1e5, 0, 3e5)), 1.0);
    scene.instances = {{0}, {1}, {0}};
    DMat4 beside = turned;
    beside[3].y += 1.0;
    static_cast<void>(mir::recentre(scene, {{turned, DMat4(1.0), beside}, {}, {}}));
    CHECK(scene.origin == DVec3(0.0));
    const mir::WorldGeometry world(scene);
    const auto at = [&](std::size_t i) { return DVec3(world.positions()[i]); };
    CHECK(largest_coordinate(at(0)) < 1e-6);
    CHECK(largest_coordinate(at(1) - DVec3(2.0 * c, 0, -2.0 * s)) < 1e-6);
    CHECK(largest_coordinate(at(2) - DVec3(2.0 * s, 0, 2.0 * c)) < 1e-6);
    CHECK(largest_coordinate(at(6) - DVec3(0, 1, 0)) < 1e-6);
    CHECK(largest_coordinate(at(3)) == 0.0);
}

TEST_CASE("meshes finer than floats where their vertices lie get a remark with the figure") {
    Scene scene;
    scene.add({});
    scene.place(triangle("rough", {100000, 0, 0}, 2.0f));
    scene.place(triangle("roughest", {100000, 0, 0}, 1.0f));
    scene.place(triangle("smooth", {100000, 0, 0}, 64.0f));
    const auto remarks = mir::recentre(scene);
    REQUIRE(remarks.size() == 1);
    CAPTURE(remarks[0]);
    // 2^-7 m between floats, and a median edge of 1 m.
    for (const char* part : {"vertices of meshes", "(2): 'roughest'", "1e+05 m", "0.00781 m apart",
                             "1/128 ", "median edge of 1 m"})
        CHECK(remarks[0].find(part) != std::string::npos);
    // The same numbers in millimetres: no mesh lies far from anything.
    Scene small;
    small.add({});
    small.place(triangle("part", {100, 0, 0}, 2.0f), mir::Mat4(0.001f));
    CHECK(mir::recentre(small).empty());
}

TEST_CASE("meshes finer than floats where the scene places them get a remark with the figure") {
    Scene scene;
    scene.add({});
    scene.place(triangle("ground", {-50000, 0, -50000}, 100000.0f));
    mir::Mat4 away(1.0f);
    away[3].x = 40000.0f;
    scene.place(triangle("blade", {0, 0, 0}, 0.25f), away);
    const auto remarks = mir::recentre(scene);
    REQUIRE(remarks.size() == 1);
    CAPTURE(remarks[0]);
    CHECK(scene.origin == DVec3(0.0));
    for (const char* part : {"the middle of the scene", "(1): 'blade'", "4e+04 m",
                             "0.00391 m apart", "1/64 ", "median edge of 0.25 m"})
        CHECK(remarks[0].find(part) != std::string::npos);
}

TEST_CASE("a scene that cannot be rendered is left for those who say why") {
    Scene scene = room();
    scene.instances[0].mesh = 1000;
    scene.meshes[1].positions[0].x = std::numeric_limits<float>::infinity();
    scene.meshes[2].triangles[0][0] = 1u << 30;
    Placements places = moved(scene, {1e5, 0, 0});
    places.instances[3][3].x = no_number;
    CHECK_NOTHROW(mir::recentre(scene, places));
    CHECK_THROWS_AS(mir::WorldGeometry(scene), mir::Error);
    Scene empty;
    CHECK(mir::recentre(empty).empty());
    CHECK(empty.origin == DVec3(0.0));
}

TEST_CASE("places that do not belong to the scene are refused") {
    Scene scene = room();
    Placements places = mir::placements_of(scene);
    places.cameras.pop_back();
    CHECK_THROWS_AS(mir::recentre(scene, places), mir::Error);
}

TEST_CASE("a near scene is taken as it is, a far one as a copy that was brought home") {
    const Scene near = room();
    CHECK(&mir::NearScene(near).scene() == &near);
    const Scene far = with_far_vertices(room(), {0, 1e5f, 0});
    const mir::NearScene home(far);
    CHECK(&home.scene() != &far);
    CHECK(home.scene().origin == DVec3(0, 1e5, 0));
    CHECK(home.remarks().size() == 1);
    CHECK(far.origin == DVec3(0.0));
}
