// SPDX-License-Identifier: MIT
//
// Scenes that lie far from the origin of their file (docs/scene_files.md, "Scenes far away").
#include "io/gltf_fixture.hpp"
#include "mir/io/gltf_writer.hpp"
#include "mir/io/scene_reader.hpp"
#include "mir/scene/scene_hash.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"

#include <string>

using namespace mirtest;
using mir::DVec3;
using mir::Vec3;

namespace {

constexpr const char* light_extension =
    R"("extensionsUsed":["KHR_lights_punctual"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"},{"type":"spot","spot":{}}]}},
"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}],)";

/// The triangle file with these nodes, of which the first is the root; a camera and two lights are
/// there to be placed.
mir::LoadedScene read_nodes(const std::string& nodes) {
    auto text = with(triangle_json(), R"({"name":"n","mesh":0})", nodes);
    return read_text(with(text, R"("scene":0)", light_extension + std::string(R"("scene":0)")),
                     triangle_bytes());
}

/// Nodes of everything, at small places below a root of this transform.
std::string everything_below(const std::string& root) {
    return R"({)" + root + R"(,"children":[1,2,3,4]},
{"mesh":0,"translation":[0.5,0,0]},
{"camera":0,"translation":[0.25,1,4]},
{"translation":[0.1,0.7,0.3],"extensions":{"KHR_lights_punctual":{"light":0}}},
{"translation":[-0.3,0.2,0.1],"extensions":{"KHR_lights_punctual":{"light":1}}})";
}

std::string hash(const mir::LoadedScene& loaded) { return mir::SceneHash(loaded.scene).hex(); }

}  // namespace

TEST_CASE("a root far away changes nothing but the origin: mesh, camera and lights stay") {
    const mir::LoadedScene home = read_nodes(everything_below(R"("translation":[0,0,0])"));
    CHECK(home.scene.origin == DVec3(0.0));
    for (const char* way : {"100000,0,-1000", "10000000,-10000000,800", "1000,1000,1000"}) {
        CAPTURE(way);
        const auto far =
            read_nodes(everything_below(std::string(R"("translation":[)") + way + "]"));
        CHECK(hash(far) == hash(home));
        CHECK(far.report.remarks.empty());
        CHECK(far.report.bounds.low == home.report.bounds.low);
        CHECK(far.report.bounds.high == home.report.bounds.high);
    }
    const auto turned = read_nodes(
        everything_below(R"("matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 100000,200000,-300000,1])"));
    CHECK(hash(turned) == hash(home));
    CHECK(turned.scene.origin == DVec3(1e5, 2e5, -3e5));
}

TEST_CASE("translations that cancel along a hierarchy leave nothing behind") {
    // 10 000 km out along a turned and scaled axis, and home again: a float would lose metres.
    const mir::LoadedScene away = read_nodes(
        R"({"translation":[6378137.25,-7000000.5,9000000.125],"children":[1]},
{"rotation":[0.1,0.2,0.3,0.9],"scale":[3,3,3],"translation":[1e6,2e6,-3e6],"children":[2]},
{"translation":[-1e6,4e6,5e6],"children":[3]},
{"translation":[1e6,-4e6,-5e6],"children":[4]},
{"translation":[0,0,0],"scale":[0.3333333333333333,0.3333333333333333,0.3333333333333333],
 "children":[5]},
{"rotation":[-0.1,-0.2,-0.3,0.9],"translation":[0,0,0],"children":[6]},
{"translation":[-1e6,-2e6,3e6],"children":[7]},
{"translation":[-6378137.25,7000000.5,-9000000.125],"children":[8,9,10]},
{"mesh":0},
{"camera":0,"translation":[0,1,4]},
{"translation":[0,2,0],"extensions":{"KHR_lights_punctual":{"light":0}}})");
    const mir::Scene& scene = away.scene;
    CHECK(scene.origin == DVec3(0.0));
    CHECK(distance(Vec3(scene.instances[0].to_world[3]), {0, 0, 0}) < 1e-6f);
    CHECK(distance(scene.cameras[0].position, {0, 1, 4}) < 1e-6f);
    CHECK(distance(scene.cameras[0].back, {0, 0, 1}) < 1e-6f);
    CHECK(distance(scene.point_lights[0].position, {0, 2, 0}) < 1e-6f);
}

TEST_CASE("camera and lights that have far nodes of their own stand where the mesh is") {
    const mir::LoadedScene loaded = read_nodes(
        R"({"children":[1,2,3,4]},
{"mesh":0,"translation":[4000000.125,0,0]},
{"camera":0,"translation":[4000000.625,1,4]},
{"translation":[4000000,2.25,0.5],"extensions":{"KHR_lights_punctual":{"light":0}}},
{"translation":[3999999.75,2,0],"extensions":{"KHR_lights_punctual":{"light":1}}})");
    const mir::Scene& scene = loaded.scene;
    CHECK(scene.origin == DVec3(4e6, 0, 0));
    CHECK(Vec3(scene.instances[0].to_world[3]) == Vec3(0.125f, 0, 0));
    CHECK(scene.cameras[0].position == Vec3(0.625f, 1, 4));
    CHECK(scene.point_lights[0].position == Vec3(0, 2.25f, 0.5f));
    CHECK(scene.spot_lights[0].position == Vec3(-0.25f, 2, 0));
}

TEST_CASE("vertices far away are brought home and named in a remark, whatever the format") {
    const TemporaryFolder folder("far_placement");
    write_file(folder / "far.obj", "v 100000 0 0\nv 100001 0 0\nv 100000 0 -1\nf 1 2 3\n");
    write_file(folder / "far.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n100000 0 0\n100001 0 0\n100000 0 -1\n3 0 1 2\n");
    write_file(folder / "data.bin", bytes_of<float>({100000, 0, 0, 100001, 0, 0, 100000, 0, -1}) +
                                        bytes_of<std::uint8_t>({0, 1, 2, 0}));
    write_file(folder / "far.gltf", triangle_json());
    for (const char* name : {"far.obj", "far.ply", "far.gltf"}) {
        CAPTURE(name);
        const mir::LoadedScene loaded = mir::read_scene(folder / name);
        CHECK(loaded.scene.origin == DVec3(1e5, 0, 0));
        CHECK(loaded.report.bounds.low == Vec3(0, 0, -1));
        CHECK(loaded.report.bounds.high == Vec3(1, 0, 0));
        REQUIRE(loaded.report.remarks.size() == 1);
        CAPTURE(loaded.report.remarks[0]);
        CHECK(loaded.report.remarks[0].find("0.00781 m apart, 1/128 of its median edge of 1 m") !=
              std::string::npos);
    }
}

TEST_CASE("a far scene that is written comes back to its place with every bit") {
    const TemporaryFolder folder("far_placement");
    mir::Scene scene = mir::builtin::make("cornell-box");
    scene.point_lights.push_back({"bulb", {0.1f, 0.7f, 0.3f}, {1, 1, 1}});
    scene.origin = {1e7, -1e5, 1e3};
    mir::write_glb(scene, folder / "far.glb");
    const mir::LoadedScene back = mir::read_gltf(folder / "far.glb");
    CHECK(back.scene.origin == scene.origin);
    CHECK(hash(back) == mir::SceneHash(scene).hex());
}
