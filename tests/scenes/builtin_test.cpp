// SPDX-License-Identifier: MIT
#include "conformance/brute_force.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/scene/scene_hash.hpp"
#include "mir/scenes.hpp"
#include "scenes/furniture.hpp"
#include "support/catch.hpp"
#include "support/mesh_measures.hpp"

#include <set>

namespace {

using mir::Scene;
using mir::Vec3;
using mir::WorldGeometry;
using mirtest::Approx;
namespace builtin = mir::builtin;

const mir::Mesh& mesh(const Scene& scene, const std::string& name) {
    for (const mir::Mesh& m : scene.meshes)
        if (m.name == name) return m;
    FAIL("no mesh " << name);
    return scene.meshes.front();
}

std::size_t triangle_count(const Scene& scene) {
    std::size_t sum = 0;
    for (const mir::Instance& i : scene.instances) sum += scene.meshes[i.mesh].triangles.size();
    return sum;
}

}  // namespace

TEST_CASE("every built-in scene builds, keeps all its triangles, has light and a camera") {
    std::set<std::string> hashes;
    for (const builtin::Entry& entry : builtin::scenes) {
        CAPTURE(entry.name);
        const Scene s = builtin::make(entry.name);
        CHECK(s.name == entry.name);
        CHECK_FALSE(entry.description.empty());
        const WorldGeometry geometry(s);
        CHECK(geometry.triangles().size() == triangle_count(s));
        CHECK(geometry.dropped_triangles() == 0);
        CHECK(mir::LightTable(s, geometry).power() > 0.0);
        REQUIRE(s.cameras.size() == 1);
        CHECK(s.cameras[0].aspect_ratio > 0.0f);
        hashes.insert(mir::SceneHash(s).hex());
        CHECK(mir::SceneHash(entry.make()).hex() == mir::SceneHash(s).hex());
    }
    CHECK(hashes.size() == builtin::scenes.size());
}

TEST_CASE("an unknown name is refused with the list of names") {
    try {
        builtin::make("teapot");
        FAIL("no error");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::invalid_argument);
        const std::string what = e.what();
        CHECK(what.find("'teapot'") != std::string::npos);
        for (const builtin::Entry& entry : builtin::scenes)
            CHECK(what.find(entry.name) != std::string::npos);
    }
}

TEST_CASE("the sphere has about the paper's 2000 triangles") {
    for (const char* name : {"sphere", "sphere-indirect"}) {
        const WorldGeometry geometry(builtin::make(name));
        CHECK(geometry.triangles().size() > 1800);
        CHECK(geometry.triangles().size() < 2200);
    }
}

TEST_CASE("the other scenes of the paper have about its numbers of triangles") {
    const std::size_t car = triangle_count(builtin::make("car"));
    CHECK(car > 460'000);
    CHECK(car < 500'000);
    CHECK(triangle_count(builtin::make("car-indirect")) == car);
    const std::size_t grille = triangle_count(builtin::make("car-grille"));
    CHECK(grille > 1'350'000);
    CHECK(grille < 1'450'000);
    CHECK(triangle_count(builtin::make("car-grille-indirect")) == grille);
    const std::size_t garage = triangle_count(builtin::make("garage"));
    CHECK(static_cast<double>(garage) == Approx(static_cast<double>(car)).epsilon(0.05));
}

TEST_CASE("rooms of the car and its garage are closed, what stands in them faces outwards") {
    for (const char* name : {"car", "garage"}) {
        const Scene s = builtin::make(name);
        for (const mir::Mesh& m : s.meshes) {
            if (m.triangles.size() > 100 || s.materials[m.material].emits()) continue;
            CAPTURE(name, m.name);
            CHECK(mirtest::is_closed(m));
            CHECK((mirtest::volume(m) > 0.0) == (m.name != "shell"));
        }
    }
}

TEST_CASE("rooms are closed and turned inwards, what stands in them outwards") {
    const Scene s = builtin::make("sphere");
    CHECK(mirtest::is_closed(mesh(s, "shell")));
    CHECK(mirtest::volume(mesh(s, "shell")) == Approx(-8.0 * 4 * 12));
    for (const char* solid : {"plane", "plinth", "sphere"}) {
        CHECK(mirtest::is_closed(mesh(s, solid), 1e-5f));
        CHECK(mirtest::volume(mesh(s, solid)) > 0.0);
    }
    const Scene furnace = builtin::make("furnace");
    CHECK(mesh(furnace, "box").triangles.size() == 12);
    const Scene cornell = builtin::make("cornell-box");
    for (const char* block : {"tall block", "short block"}) {
        CHECK(mirtest::is_closed(mesh(cornell, block)));
        CHECK(mirtest::volume(mesh(cornell, block)) > 0.0);
    }
}

TEST_CASE(
    "the room behind a door ajar is closed and small, its lamps are behind the wall and face the "
    "ceiling") {
    const Scene s = builtin::make("door-ajar");
    const WorldGeometry geometry(s);
    CHECK(geometry.triangles().size() < 500);
    CHECK(mirtest::is_closed(mesh(s, "shell")));
    CHECK(mirtest::volume(mesh(s, "shell")) == Approx(-6.0 * 3 * 12));
    CHECK(s.cameras[0].position.z > 0.0f);
    for (const mir::Mesh& m : s.meshes) {
        CAPTURE(m.name);
        if (m.name == "lamp") {
            CHECK(mirtest::normal(m, m.triangles[0]).y == Approx(1.0f));
            for (const Vec3& p : m.positions) CHECK(p.z < -0.1f);
        } else if (m.name != "shell") {
            CHECK(mirtest::is_closed(m));
            CHECK(mirtest::volume(m) > 0.0);
        }
    }
}

TEST_CASE("the door ajar leaves a gap that the camera cannot look through") {
    const Scene s = builtin::make("door-ajar");
    const WorldGeometry geometry(s);
    const mirtest::BruteForceVisibility sight{mirtest::Referee(geometry)};
    const Vec3 before_gap(0.74f, 1, 1);
    const Vec3 camera = s.cameras[0].position;
    CHECK(sight.visible({1.6f, 1, -1.5f}, before_gap));
    CHECK(sight.visible(before_gap, camera));
    std::size_t seen = 0;
    for (float y = 0.05f; y < 2.1f; y += 0.1f)
        for (float x = 1.01f; x < 1.9f; x += 0.02f)
            seen += sight.visible({x, y, -0.2f}, camera) ? 1u : 0u;
    CHECK(seen == 0);
}

TEST_CASE("the furnace's walls all emit towards its centre") {
    const Scene s = builtin::furnace_box(0.25f, 0.75f);
    const WorldGeometry geometry(s);
    for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t)
        CHECK(glm::dot(geometry.front_normal(t), -geometry.corner(t, 0)) > 0.0f);
    CHECK(mirtest::is_closed(s.meshes[0]));
    CHECK(mir::LightTable(s, geometry).power() == Approx(0.75 * mirtest::pi * 24));
    CHECK(s.materials[0].base_color.r == 0.25f);
}

TEST_CASE("walls of the Cornell box face its inside and lamps the way they are named") {
    for (const char* name : {"cornell-box", "cornell-inverted"}) {
        const Scene s = builtin::make(name);
        for (const char* wall : {"floor", "ceiling", "back wall", "left wall", "right wall"}) {
            const mir::Mesh& m = mesh(s, wall);
            for (const auto& t : m.triangles)
                CHECK(glm::dot(mirtest::normal(m, t), Vec3(0, 1, 0) - m.positions[t[0]]) > 0.0f);
        }
    }
    const auto lamp_normal = [](const char* scene, const char* lamp) {
        const Scene s = builtin::make(scene);
        return mirtest::normal(mesh(s, lamp), mesh(s, lamp).triangles[0]).y;
    };
    CHECK(lamp_normal("cornell-box", "lamp") == Approx(-1.0f));
    CHECK(lamp_normal("cornell-inverted", "lamp") == Approx(1.0f));
    CHECK(lamp_normal("sphere", "main lamp") == Approx(-1.0f));
    CHECK(lamp_normal("sphere-indirect", "main lamp") == Approx(1.0f));
    CHECK(lamp_normal("sphere-indirect", "far lamp") == Approx(-1.0f));
    for (const char* name : {"car", "car-grille"})
        CHECK(lamp_normal(name, "main lamp") == Approx(-1.0f));
    for (const char* name : {"car-indirect", "car-grille-indirect"})
        CHECK(lamp_normal(name, "main lamp") == Approx(1.0f));
    CHECK(lamp_normal("car", "far lamp") == Approx(-1.0f));
    CHECK(lamp_normal("garage", "lamp") == Approx(-1.0f));
}

TEST_CASE("receivers and lamps of the check rooms face each other") {
    for (const char* name : {"parallel-squares", "perpendicular-squares", "disc-above-plane"}) {
        CAPTURE(name);
        const Scene s = builtin::make(name);
        const mir::Mesh& receiver = mesh(s, "receiver");
        const mir::Mesh& lamp = mesh(s, "lamp");
        const auto centre = [](const mir::Mesh& m) {
            return 0.5f * (m.positions[0] + m.positions[2]);
        };
        const Vec3 d = centre(lamp) - centre(receiver);
        CHECK(glm::dot(mirtest::normal(receiver, receiver.triangles[0]), d) > 0.0f);
        CHECK(glm::dot(mirtest::normal(lamp, lamp.triangles[0]), d) < 0.0f);
    }
}

TEST_CASE("a turned block keeps its size and is turned about its corner") {
    const mir::Mesh m = builtin::turned_block("b", 0, {1, 0, 2}, 0.5f, 2.0f, 0.7f);
    CHECK(mirtest::volume(m) == Approx(0.5));
    CHECK(m.positions[0] == Vec3(1, 0, 2));
}
