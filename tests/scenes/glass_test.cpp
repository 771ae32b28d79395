// SPDX-License-Identifier: MIT
#include "mir/scene/world_geometry.hpp"
#include "mir/scenes.hpp"
#include "scenes/solids.hpp"
#include "support/catch.hpp"
#include "support/mesh_measures.hpp"

namespace {

using mir::Mesh;
using mir::Scene;
using mirtest::Approx;
namespace builtin = mir::builtin;

const Mesh& mesh(const Scene& scene, const std::string& name) {
    for (const Mesh& m : scene.meshes)
        if (m.name == name) return m;
    FAIL("no mesh " << name);
    return scene.meshes.front();
}

const mir::Material& material(const Scene& scene, const std::string& name) {
    return scene.materials[mesh(scene, name).material];
}

}  // namespace

TEST_CASE("scenes of glass, mirrors and leaves are small and have what they are named for") {
    for (const char* name : {"glass-room", "caustics", "leaves", "sphere-behind-glass"}) {
        CAPTURE(name);
        const mir::WorldGeometry geometry(builtin::make(name));
        CHECK(geometry.triangles().size() > 400);
        CHECK(geometry.triangles().size() < 5000);
    }
    const Scene room = builtin::make("glass-room");
    CHECK(material(room, "pane").is_see_through());
    CHECK(material(room, "mirror").metallic == 1.0f);
    CHECK(material(room, "mirror").roughness == 0.0f);
    const Scene hedge = builtin::make("leaves");
    CHECK(material(hedge, "leaves").is_masked());
    CHECK(material(hedge, "pale leaves").is_blended);
}

TEST_CASE("three interfaces close the glass and the water of a tumbler") {
    const Scene s = builtin::make("glass-room");
    const Mesh& tumbler = mesh(s, "tumbler");
    const Mesh& wet = mesh(s, "wet tumbler");
    const Mesh& surface = mesh(s, "water");
    const Mesh glass = builtin::joined("glass", 0, {tumbler, wet});
    const Mesh water = builtin::joined("water", 0, {surface, builtin::inside_out(wet)});
    CHECK_FALSE(mirtest::is_closed(tumbler));
    CHECK(mirtest::is_closed(glass));
    CHECK(mirtest::is_closed(water));
    CHECK(mirtest::volume(water) > 180e-6);
    CHECK(mirtest::volume(water) < 220e-6);
    CHECK(mirtest::volume(glass) > 40e-6);
    CHECK(mirtest::volume(glass) < 100e-6);
    CHECK(material(s, "tumbler").ior ==
          Approx(material(s, "wet tumbler").ior * material(s, "water").ior));
}

TEST_CASE("a ring, a ball and a lampshade are closed bodies") {
    const Scene table = builtin::make("caustics");
    for (const char* name : {"ring", "ball"}) {
        CHECK(mirtest::is_closed(mesh(table, name)));
        CHECK(mirtest::volume(mesh(table, name)) > 0.0);
    }
    const Scene s = builtin::make("sphere-behind-glass");
    const Mesh& cavity = mesh(s, "lampshade, inside");
    CHECK(mirtest::volume(mesh(s, "lampshade")) > 0.0);
    CHECK(mirtest::volume(cavity) < 0.0);
    for (const mir::Vec3& p : mesh(s, "main lamp").positions)
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(p[axis] > cavity.positions[0][axis]);
            CHECK(p[axis] < cavity.positions[6][axis]);
        }
}
