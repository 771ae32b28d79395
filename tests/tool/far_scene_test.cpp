// SPDX-License-Identifier: MIT
//
// Scenes far from the origin of their file, through the program (docs/scene_files.md).
#include "mir/io/gltf_writer.hpp"
#include "mir/scenes.hpp"
#include "tool/exr_file.hpp"
#include "tool/mir_program.hpp"

#include <OpenEXR/ImfVecAttribute.h>
#include <nlohmann/json.hpp>

using namespace mirtest;
using nlohmann::json;

namespace {

/// The Cornell box with a bulb, written with all its nodes moved by `way`.
std::string write_box(const TemporaryFolder& folder, const std::string& name, mir::DVec3 way) {
    mir::Scene scene = mir::builtin::make("cornell-box");
    scene.point_lights.push_back({"bulb", {0.25f, 1.5f, 0.5f}, {1, 2, 3}});
    scene.origin = way;
    std::string file = (folder / (name + ".glb")).string();
    mir::write_glb(scene, file);
    return file;
}

/// Attribute mir:origin of a picture; zero where it has none.
mir::DVec3 origin_of(const std::string& picture) {
    const Imf::InputFile file(picture.c_str());
    const auto* v = file.header().findTypedAttribute<Imf::V3dAttribute>("mir:origin");
    return v == nullptr ? mir::DVec3(0.0) : mir::DVec3(v->value().x, v->value().y, v->value().z);
}

/// The same pixels in every bit.
bool same_layer(const std::string& a, const std::string& b, const std::string& layer) {
    return largest_difference(mir::read_exr(a, layer).image, mir::read_exr(b, layer).image) == 0;
}

}  // namespace

TEST_CASE("a scene that nodes put 1 to 10 000 km away gives the picture that it gives at home") {
    const TemporaryFolder folder("far_scene");
    const std::string home = write_box(folder, "home", {0, 0, 0});
    for (const char* integrator : {"vpl", "path", "micro"}) {
        const std::string near = (folder / "near.exr").string();
        const Words how{"--integrator", integrator, "--surfels",
                        "256",          "--aov",    "position,depth,direct,indirect"};
        REQUIRE(run_mir(small_render(near, home) + how).exit_code == 0);
        CHECK(origin_of(near) == mir::DVec3(0.0));
        for (const mir::DVec3 way :
             {mir::DVec3(1000, 0, -1000), mir::DVec3(0, 1e5, 1e5), mir::DVec3(-1e7, 1e7, 1e7)}) {
            CAPTURE(integrator, way.x, way.y, way.z);
            const std::string far = (folder / "far.exr").string();
            const std::string scene = write_box(folder, "far", way);
            REQUIRE(run_mir(small_render(far, scene) + how).exit_code == 0);
            CHECK(origin_of(far) == way);
            for (const char* layer : {"", "position", "depth", "direct", "indirect"})
                CHECK(same_layer(near, far, layer));
        }
    }
}

TEST_CASE("a distance that no float holds moves a picture by no more than rounding does") {
    const TemporaryFolder folder("far_scene");
    const std::string near = (folder / "near.exr").string();
    const std::string far = (folder / "far.exr").string();
    // Direct light alone: where a bit differs, paths part for good. Shadow rays part at edges.
    const Words how{"--integrator", "path", "--bounces", "1", "--aov", "all"};
    REQUIRE(run_mir(small_render(near, write_box(folder, "home", {0, 0, 0})) + how).exit_code == 0);
    const std::string scene = write_box(folder, "far", {6378137.123, -1234567.89, 0.1});
    REQUIRE(run_mir(small_render(far, scene) + how).exit_code == 0);
    const auto a = mir::read_exr(near).image;
    const auto b = mir::read_exr(far).image;
    double sum = 0.0;
    double difference = 0.0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        sum += static_cast<double>(luminance(a.pixels()[i]));
        difference += std::fabs(static_cast<double>(luminance(a.pixels()[i])) -
                                static_cast<double>(luminance(b.pixels()[i])));
    }
    CHECK(sum > 0.0);
    CHECK(difference < 5e-3 * sum);
}

TEST_CASE("cameras of the command line stand in the coordinates of the file") {
    const TemporaryFolder folder("far_scene");
    const std::string near = (folder / "near.exr").string();
    const std::string far = (folder / "far.exr").string();
    const auto view = [](const char* eye, const char* target) {
        return Words{"--eye", eye, "--look-at", target, "--sun", "1,2,1"};
    };
    REQUIRE(run_mir(small_render(near, write_box(folder, "home", {0, 0, 0})) +
                    view("0.25,1,6.5", "0,1,0"))
                .exit_code == 0);
    REQUIRE(run_mir(small_render(far, write_box(folder, "far", {1e7, 0, -1e5})) +
                    view("10000000.25,1,-99993.5", "10000000,1,-100000"))
                .exit_code == 0);
    CHECK(same_layer(near, far, ""));
}

TEST_CASE("info, render, report, files of VPLs and compare name the origin of a far scene") {
    const TemporaryFolder folder("far_scene");
    const std::string scene = write_box(folder, "far", {1e7, 0, -1e5});
    const json info = json::parse(run_mir({"info", scene, "--json"}).out);
    CHECK(info.at("origin") == json{1e7, 0.0, -1e5});
    CHECK(info.at("bounds").at("low")[0] == 1e7 - 1.0);
    CHECK(has(run_mir({"info", scene}).out, "origin                   (10000000, 0, -100000) m"));
    const std::string picture = (folder / "a.exr").string();
    const std::string report = (folder / "a.html").string();
    const std::string vpls = (folder / "a.ply").string();
    const Outcome outcome = run_mir(small_render(picture, scene) +
                                    Words{"--json", "--report", report, "--vpls-out", vpls});
    REQUIRE(outcome.exit_code == 0);
    CHECK(json::parse(outcome.out).at("origin") == json{1e7, 0.0, -1e5});
    CHECK(has(file_bytes(report), "(10000000, 0, -100000) m"));
    CHECK(has(file_bytes(vpls), "comment origin of positions, metres: 10000000 0 -100000\n"));
    const Outcome compared = run_mir({"compare", picture, picture, "--json"});
    CHECK(json::parse(compared.out).at("origin").at("reference") == json{1e7, 0.0, -1e5});
    CHECK(has(run_mir({"compare", picture, picture}).out,
              "origin of reference  (10000000, 0, -100000) m"));
}

TEST_CASE("a picture that goes on from its journal keeps its origin") {
    const TemporaryFolder folder("far_scene");
    const std::string scene = write_box(folder, "far", {0, 1e5, 0});
    const std::string picture = (folder / "a.exr").string();
    const Words passes = small_render(picture, scene) + Words{"--passes", "1", "--resume"};
    for (int run = 0; run < 2; ++run) {
        REQUIRE(run_mir(passes).exit_code == 0);
        CHECK(origin_of(picture) == mir::DVec3(0, 1e5, 0));
    }
}

TEST_CASE("near scenes and their pictures say nothing of an origin") {
    const TemporaryFolder folder("far_scene");
    const std::string picture = (folder / "a.exr").string();
    const Outcome outcome = run_mir(small_render(picture) + Words{"--json"});
    REQUIRE(outcome.exit_code == 0);
    CHECK_FALSE(json::parse(outcome.out).contains("origin"));
    CHECK_FALSE(has(run_mir({"compare", picture, picture}).out, "origin"));
    CHECK_FALSE(has(run_mir({"info", "builtin:cornell-box"}).out, "origin"));
}

TEST_CASE("vertices that a file rounded far away are among the warnings of a render") {
    const TemporaryFolder folder("far_scene");
    const std::string scene = (folder / "far.obj").string();
    std::ofstream(scene) << "v 100000 0 0\nv 100001 0 0\nv 100000 0 -1\nf 1 2 3\n";
    const Words light{"--sun", "0,1,0", "--json"};
    const Outcome outcome = run_mir(small_render((folder / "a.exr").string(), scene) + light);
    REQUIRE(outcome.exit_code == 0);
    const json warnings = json::parse(outcome.out).at("warnings");
    REQUIRE_FALSE(warnings.empty());
    CHECK(has(warnings[0].get<std::string>(), "1/128 of its median edge of 1 m"));
    const json info = json::parse(run_mir({"info", scene, "--json"}).out);
    CHECK(info.at("remarks") == json::array({warnings[0]}));
    CHECK(has(run_mir({"info", scene}).out, "remark: vertices of meshes lie far"));
}

TEST_CASE("what lies farther away than rays reach is refused by name") {
    const TemporaryFolder folder("far_scene");
    const mir::Scene room = mir::builtin::make("cornell-box");
    Words structures{"bvh", "kdtree"};
    if (!has(run_mir({"devices"}).out, "no Embree")) structures.push_back("embree");
    const auto check_refused = [&](const mir::Scene& scene, const std::string& says) {
        const std::string file = (folder / "far.glb").string();
        mir::write_glb(scene, file);
        for (const std::string& accel : structures)
            check_failing_render({file, "--accel", accel, "--backend", "cpu"}, 3, says);
    };
    mir::Scene scene = room;
    scene.point_lights.push_back({"star", {0, 2e18f, 0}, {1, 1, 1}});
    check_refused(scene, "light 'star' lies 2e+18 m");
    scene = room;
    scene.spot_lights.emplace_back().name = "beam";
    scene.spot_lights[0].position.x = -3e30f;
    check_refused(scene, "light 'beam' lies 3e+30 m");
    scene = room;
    scene.cameras[0].position.z = 2e18f;
    check_refused(scene, "camera 'front' lies 2e+18 m");
    scene = room;
    scene.instances[0].to_world[3].x = 2e18f;
    check_refused(scene, "a mesh lies");
}
