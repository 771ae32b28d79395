// SPDX-License-Identifier: MIT
#include "support/shared_scenes.hpp"
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <map>

using namespace mirtest;
using nlohmann::json;

namespace {

json info_json(const std::string& scene) {
    const Outcome outcome = run_mir({"info", scene, "--json"});
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    return json::parse(outcome.out);
}

/// Path of a shared scene; empty, with a word why, where this machine has none.
std::string shared(const std::string& name) {
    const auto folder = shared_scenes();
    if (!folder || !std::filesystem::exists(*folder / name)) {
        WARN("shared scene '" << name << "' is not on this machine; skipped");
        return "";
    }
    return (*folder / name).string();
}

}  // namespace

TEST_CASE("info counts what a scene holds") {
    const json info = info_json("builtin:cornell-box");
    CHECK(info.at("scene") == "builtin:cornell-box");
    CHECK(info.at("scene_hash").get<std::string>().size() == 16);
    const json& counts = info.at("counts");
    CHECK(counts.at("triangles") == 36);
    CHECK(counts.at("stored_triangles") == 36);
    CHECK(counts.at("emitting_triangles") == 2);
    CHECK(counts.at("emitting_materials") == 1);
    for (const char* key : {"vertices", "meshes", "instances", "materials", "point_lights",
                            "spot_lights", "directional_lights"})
        CHECK(counts.at(key).is_number_unsigned());
    CHECK(info.at("bounds").at("low").size() == 3);
    CHECK(info.at("bounds").at("high").size() == 3);
    REQUIRE(info.at("cameras").size() == 1);
    CHECK(info.at("cameras")[0].at("usable") == true);
    CHECK(info.at("ignored").empty());
    CHECK(info.at("notes").empty());
}

TEST_CASE("info tells people the same") {
    const Outcome outcome = run_mir({"info", "builtin:cornell-box"});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    CHECK(lines_of(outcome.out).at(0) == "builtin:cornell-box");
    CHECK(has(outcome.out, "emitting triangles       2"));
    CHECK(has(outcome.out, " m\n"));
    CHECK(has(outcome.out, "camera '"));
}

TEST_CASE("output that cannot be written is a failure") {
    if (!std::filesystem::exists("/dev/full")) {
        WARN("this system has no /dev/full; skipped");
        return;
    }
    RunningProgram info(mir_command({"info", "builtin:cornell-box"}), ".", "/dev/full");
    const Outcome outcome = info.wait();
    CHECK(outcome.exit_code == 1);
    CHECK(lines_of(outcome.err).size() == 1);
    CHECK(outcome.err.rfind("mir: ", 0) == 0);
}

TEST_CASE("every shared file with one glTF feature is read, or refused with its extension named") {
    const std::string folder = shared("gltf-features");
    if (folder.empty()) return;
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string ending = entry.path().extension().string();
        if (ending != ".gltf" && ending != ".glb") continue;
        INFO(entry.path());
        ++files;
        if (entry.path().filename() == "heart_draco.glb") {
            check_failure(run_mir({"info", entry.path().string()}), 3,
                          "KHR_draco_mesh_compression");
            continue;
        }
        const Outcome outcome = run_mir({"info", entry.path().string()});
        CHECK(outcome.exit_code == 0);
        CHECK(outcome.err.empty());
        CHECK_FALSE(outcome.out.empty());
    }
    CHECK(files == 15);
}

TEST_CASE("info tells what a file holds that is not supported") {
    if (shared("gltf-features").empty()) return;
    const json textured =
        info_json(shared("gltf-features/09_texture_transform/09_texture_transform.gltf"));
    CHECK(textured.at("ignored").at("texture occlusionTexture") == 1);
    CHECK(textured.at("ignored").size() == 1);
    const json cameras = info_json(shared("gltf-features/Cameras/Cameras.gltf")).at("cameras");
    REQUIRE(cameras.size() == 2);
    CHECK(cameras[0].at("usable") == true);
    CHECK(cameras[1].at("usable") == false);
    CHECK(cameras[1].at("kind") == "orthographic");
    const json lights = info_json(shared("gltf-features/Lights.glb")).at("counts");
    CHECK(lights.at("point_lights") == 1);
    CHECK(lights.at("spot_lights") == 2);
    CHECK(lights.at("directional_lights") == 1);
}

TEST_CASE("info reads OBJ and PLY, and names the place of what is wrong in them") {
    const TemporaryFolder folder("info_meshes");
    const std::string obj = (folder / "scene.OBJ").string();
    std::ofstream(obj) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n";
    CHECK(info_json(obj).at("counts").at("triangles") == 1);
    CHECK(info_json(obj).at("ignored").at("lines") == 1);
    const std::string ply = (folder / "scene.ply").string();
    std::ofstream(ply) << "ply\nformat ascii 1.0\nelement vertex 1000000000\nproperty float x\n"
                          "end_header\n1\n";
    check_failure(run_mir({"info", ply}), 3, "header, line 3: it announces 1000000000");
}

TEST_CASE("info and render say what one will see of what is not supported") {
    const TemporaryFolder folder("info_effects");
    const std::string obj = (folder / "scene.obj").string();
    std::ofstream(obj) << "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl glass\nf 1 2 3\n";
    std::ofstream(folder / "a.mtl") << "newmtl glass\nTf .5 1 1\nKd 1 1 1\n";
    const std::string name = "Tf without a model of glass";
    const std::string words = "the surface lets no coloured light through";
    CHECK(info_json(obj).at("ignored").at(name) == 1);
    CHECK(info_json(obj).at("visible_effects").at(name) == words);
    const std::string line = "ignored: " + name + " (1): " + words + "\n";
    CHECK(has(run_mir({"info", obj}).out, "  " + line));
    Words render = small_render(folder / "a.exr", obj) + Words{"--sun", "0,0,1"};
    render.erase(std::find(render.begin(), render.end(), "--quiet"));
    CHECK(has(run_mir(render).err, "mir: " + obj + ": " + line));
}

TEST_CASE("the triangles of the shared scenes are those of their table") {
    const std::map<std::string, unsigned> triangles{
        {"cornell-box/cornell-box.glb", 36},
        {"cornell-box/cornell-box.obj", 36},
        {"ply-features/cube_binary.ply", 12},
        {"furnace/furnace-rho05.glb", 12},
        {"furnace/furnace-objects-rho05.glb", 2232},
        {"veach-mis/veach-mis.glb", 6676},
        {"bmw-m6/bmw-m6.glb", 788586},
    };
    for (const auto& [name, count] : triangles) {
        const std::string scene = shared(name);
        if (scene.empty()) continue;
        INFO(name);
        CHECK(info_json(scene).at("counts").at("triangles") == count);
    }
}
