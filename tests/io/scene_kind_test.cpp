// SPDX-License-Identifier: MIT
#include "io/gltf_fixture.hpp"
#include "mir/io/scene_reader.hpp"
#include "support/catch.hpp"

#include <string>
#include <utility>
#include <vector>

using namespace mirtest;

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// A folder with the buffer of the triangle.
class SceneFolder {
 public:
    SceneFolder() { write_file(folder_ / "data.bin", triangle_bytes()); }
    [[nodiscard]] mir::LoadedScene read(const std::string& name, const std::string& bytes) const {
        write_file(folder_ / name, bytes);
        return mir::read_scene(folder_ / name);
    }

 private:
    TemporaryFolder folder_{"scene_kind"};
};

}  // namespace

TEST_CASE("a picture is refused as one") {
    const SceneFolder folder;
    for (const char* name : {"a.exr", "a.PNG", "a.hdr"})
        CHECK(has(message_of([&] { (void)folder.read(name, triangle_json()); }),
                  std::string(name) + ": it is a picture, not a scene"));
}

TEST_CASE("files of other programs are refused with their format and what to export") {
    const SceneFolder folder;
    using Case = std::pair<std::string, std::string>;
    for (const Case& c : std::vector<Case>{{"a.fbx", "FBX"},
                                           {"a.FBX", "FBX"},
                                           {"a.blend", "Blender"},
                                           {"a.dae", "COLLADA"},
                                           {"a.3ds", "3D Studio"},
                                           {"a.usd", "USD"},
                                           {"a.usda", "USD"},
                                           {"a.usdc", "USD"},
                                           {"a.usdz", "USD"},
                                           {"a.abc", "Alembic"},
                                           {"a.stl", "STL"},
                                           {"a.max", "3ds Max"},
                                           {"a.ma", "Maya"},
                                           {"a.mb", "Maya"},
                                           {"a.c4d", "Cinema 4D"},
                                           {"a.step", "STEP"},
                                           {"a.stp", "STEP"},
                                           {"a.ifc", "IFC"}}) {
        CAPTURE(c.first);
        mir::ErrorCode code = mir::ErrorCode::internal;
        const std::string message =
            message_of([&] { (void)folder.read(c.first, triangle_json()); }, &code);
        INFO(message);
        CHECK(has(message, c.first + ": it is a file of "));
        CHECK(has(message, c.second + " (glTF"));
        CHECK(has(message, "export it as .glb"));
        CHECK(code == mir::ErrorCode::unsupported);
    }
}

TEST_CASE("a file is read by its name, or by its first bytes where that says nothing") {
    const SceneFolder folder;
    for (const char* name : {"a.gltf", "a.GLTF", "a.glb", "a.vrm", "a", "a.json", "a.scene"}) {
        CAPTURE(name);
        CHECK(folder.read(name, triangle_json()).report.triangles == 1);
        CHECK(folder.read(name, "\xef\xbb\xbf\n " + triangle_json()).report.triangles == 1);
    }
    for (const char* name : {"b.ply", "b", "b.txt"}) {
        CAPTURE(name);
        CHECK(folder.read(name, ply).report.triangles == 1);
    }
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    CHECK(folder.read("c.OBJ", obj).report.triangles == 1);
    CHECK(
        has(message_of([&] { (void)folder.read("c.txt", obj); }), "it is no valid glTF 2.0 file"));
    CHECK(has(message_of([&] { (void)mir::read_scene("no such file"); }), "no such file"));
}
