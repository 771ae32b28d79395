// SPDX-License-Identifier: MIT
#include "io/gltf_fixture.hpp"
#include "mir/io/exr.hpp"
#include "support/shared_scenes.hpp"
#include "tool/mir_program.hpp"

#include <limits>

using namespace mirtest;

namespace {

/// A folder with the file scene.gltf, a triangle by default, and its buffer.
class SceneFolder {
 public:
    explicit SceneFolder(const std::string& json, const std::string& bytes = triangle_bytes()) {
        write_file(folder_ / "scene.gltf", json);
        write_file(folder_ / "data.bin", bytes);
    }
    [[nodiscard]] std::string scene() const { return (folder_ / "scene.gltf").string(); }

 private:
    TemporaryFolder folder_{"tool_scene"};
};

/// The triangle, shining from both sides.
std::string lamp_json() {
    return with(with(triangle_json(), R"("indices":1)", R"("indices":1,"material":0)"),
                R"("scene":0)",
                R"("materials":[{"emissiveFactor":[1,1,1],"doubleSided":true}],"scene":0)");
}

/// Neither `mir info` nor `mir render` accepts the file, and both say `part`.
void check_refused(const std::string& scene, const std::string& part) {
    INFO(scene);
    check_failure(run_mir({"info", scene}), 3, part);
    check_failing_render({scene}, 3, part);
}

}  // namespace

TEST_CASE("a file that does not exist, is a folder or no scene is named") {
    const TemporaryFolder folder("tool_no_scene");
    check_refused((folder / "missing.glb").string(), "missing.glb: ");
    check_refused((folder / "").string(), "mir_test_tool_no_scene");
    write_file(folder / "words.gltf", "these are words");
    check_refused((folder / "words.gltf").string(), "words.gltf: ");
    write_file(folder / "empty.glb", "");
    check_refused((folder / "empty.glb").string(), "empty.glb: ");
    write_file(folder / "scene.stl", "solid\n");
    check_refused((folder / "scene.stl").string(), "scene.stl: ");
}

TEST_CASE("a truncated binary file is refused, wherever it ends") {
    const TemporaryFolder folder("tool_truncated");
    const std::string scene = (folder / "box.glb").string();
    REQUIRE(run_mir({"export", "builtin:cornell-box", "-o", scene}).exit_code == 0);
    const std::string whole = file_bytes(scene);
    for (const std::size_t size :
         {std::size_t{3}, std::size_t{12}, std::size_t{20}, whole.size() / 2, whole.size() - 1}) {
        INFO(size << " bytes of " << whole.size());
        write_file(scene, whole.substr(0, size));
        check_refused(scene, "box.glb: ");
    }
}

TEST_CASE("broken geometry is refused with its place") {
    const SceneFolder indices(
        triangle_json(), triangle_bytes().substr(0, 36) + bytes_of<std::uint8_t>({0, 1, 9, 0}));
    check_refused(indices.scene(), "vertex 9");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const SceneFolder positions(triangle_json(), bytes_of<float>({0, 0, 0, 1, nan, 0, 0, 1, 0}) +
                                                     bytes_of<std::uint8_t>({0, 1, 2, 0}));
    check_refused(positions.scene(), "position 1");
}

TEST_CASE("a cycle of nodes is refused") {
    const std::string node = R"({"name":"n","mesh":0})";
    const SceneFolder cycle(with(triangle_json(), node, R"({"children":[1]},{"children":[0]})"));
    check_refused(cycle.scene(), "cycle");
}

TEST_CASE("an extension that is required and not known is named") {
    const SceneFolder required(
        with(triangle_json(), R"("scene":0)", R"("extensionsRequired":["MY_ext"],"scene":0)"));
    check_refused(required.scene(), "MY_ext");
}

TEST_CASE("a scene without camera is framed, and a word says so") {
    const SceneFolder lamp(lamp_json());
    const TemporaryFolder folder("tool_framed");
    const Outcome quiet = run_mir(small_render(folder / "a.exr", lamp.scene()));
    CHECK(quiet.exit_code == 0);
    CHECK(quiet.err.empty());
    Words loud = small_render(folder / "a.exr", lamp.scene());
    loud.back() = "--aov=emission";
    CHECK(has(run_mir(loud).err, "no usable camera; it is seen from outside"));
    float brightest = 0.0f;
    const auto emission = mir::read_exr(folder / "a.exr", "emission").image;
    for (const mir::Rgb& pixel : emission.pixels()) brightest = std::max(brightest, pixel.g);
    CHECK(brightest > 0.9f);
}

TEST_CASE("files outside of the folder of a scene are read where that is allowed") {
    const TemporaryFolder folder("tool_outside");
    std::filesystem::create_directory(folder / "scene");
    write_file(folder / "lamp.mtl", "newmtl lamp\nKe 1 1 1\n");
    const std::string scene = (folder / "scene/scene.obj").string();
    write_file(scene, "mtllib ../lamp.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl lamp\nf 1 2 3\n");
    check_refused(scene, "--allow-outside");
    CHECK(run_mir({"info", scene, "--allow-outside"}).exit_code == 0);
    const Words allowed{"--allow-outside"};
    CHECK(run_mir(small_render(folder / "a.exr", scene) + allowed).exit_code == 0);
    const std::string copy = (folder / "a.glb").string();
    CHECK(run_mir({"export", scene, "-o", copy, "--allow-outside"}).exit_code == 0);
}

TEST_CASE("names in a file reach neither terminal nor JSON as commands") {
    const TemporaryFolder folder("tool_names");
    const std::string scene = (folder / "sc\x1b[31mene.obj").string();
    const std::string good = "v 0 0 0\nv 1 0 0\nv 0 1 0\n\x1b[31mred\xe2\x80\xae 1\nf 1 2 3\n";
    const auto is_plain = [](const std::string& text) {
        return !has(text, "\x1b") && !has(text, "\xe2\x80\xae");
    };
    write_file(scene, good);
    for (const Words& more : {Words{}, Words{"--json"}}) {
        const Outcome info = run_mir(Words{"info", scene} + more);
        CHECK(info.exit_code == 0);
        CHECK(has(info.out, "[31mred"));
        CHECK(is_plain(info.out));
    }
    write_file(scene, good + "f 1 2 \x1b[0m\n");
    const Outcome broken = run_mir({"info", scene});
    check_failure(broken, 3, "sc\\x1b[31mene.obj: line 6: ");
    CHECK(is_plain(broken.err));
    const Outcome usage = run_mir({"info", scene, "--\x1b[31m"});
    CHECK(usage.exit_code == 2);
    CHECK(is_plain(usage.err));
}

TEST_CASE("a scene whose triangles have no area, or whose lamp is not there, is refused") {
    const TemporaryFolder folder("tool_nothing");
    const std::string scene = (folder / "scene.obj").string();
    const std::string triangle = "mtllib lamp.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\n";
    write_file(folder / "lamp.mtl", "newmtl lamp\nKe 1 1 1\n");
    write_file(scene, triangle + "usemtl lamp\nf 1 2 4\n");
    check_failing_render({scene, "--quiet"}, 3, "nothing to draw");
    write_file(scene, triangle + "f 1 2 3\n");
    check_failing_render({scene}, 3, "has no light");
    write_file(folder / "lamp.mtl", "newmtl lamp\nKe 3e38\n");
    write_file(scene, triangle + "v 0 9 0\nusemtl lamp\nf 1 4 5\n");
    check_failing_render({scene, "--quiet"}, 3, "material 'lamp' emits more power");
}

TEST_CASE("a scene without light is refused unless black is allowed") {
    const SceneFolder dark(triangle_json());
    check_failing_render({dark.scene()}, 3, "has no light");
    check_failing_render({dark.scene()}, 3, dark.scene());
    const TemporaryFolder folder("tool_dark");
    const Words allowed = small_render(folder / "a.exr", dark.scene()) + Words{"--allow-no-light"};
    const Outcome outcome = run_mir(allowed);
    CHECK(outcome.exit_code == 0);
    const auto picture = mir::read_exr(folder / "a.exr").image;
    for (const mir::Rgb& pixel : picture.pixels()) CHECK(mir::is_black(pixel));
    CHECK_FALSE(file_bytes(folder / "a.png").empty());
}

TEST_CASE("a scene without triangles is read but cannot be rendered") {
    const SceneFolder empty(with(triangle_json(), R"("nodes":[0])", R"("nodes":[])"));
    const Outcome info = run_mir({"info", empty.scene()});
    CHECK(info.exit_code == 0);
    CHECK(has(info.out, "no triangles"));
    check_failing_render({empty.scene()}, 3, "no triangles");
    check_failing_render({empty.scene(), "--allow-no-light"}, 3, "no triangles");
}

TEST_CASE("an output that cannot be written is known before the scene is read") {
    const TemporaryFolder folder("tool_unwritable");
    const auto render_to = [&](const std::string& name, const Words& more = {}) {
        return run_mir(small_render(folder / name, "missing.glb") + more);
    };
    check_failure(render_to("none/a.exr"), 1, "none/a.exr");
    std::filesystem::create_directory(folder / "there.exr");
    check_failure(render_to("there.exr"), 1, "there.exr");
    check_failure(render_to(""), 1);
    check_failure(render_to("a.exr", {"--png", (folder / "none/b.png").string()}), 1, "none/b.png");
    check_failure(run_mir({"render", "builtin:sphere", "-o", "-"}), 2, "standard output");
    CHECK(folder.files() == 1);
}

TEST_CASE("paths that loop or are too long are refused with the reason") {
    const TemporaryFolder folder("tool_paths");
    std::filesystem::create_symlink("loop", folder / "loop");
    const std::string name(300, 'a');
    const auto check = [&](const std::string& path, const std::string& why) {
        INFO(path);
        check_refused((folder / path).string(), "(" + why + ")");
        check_failure(run_mir(small_render(folder / path)), 1, "(" + why + ")");
        check_failure(run_mir({"export", "builtin:furnace", "-o", (folder / path).string()}), 1,
                      "(" + why + ")");
    };
    check("loop/a.glb", "Too many levels of symbolic links");
    check("loop", "Too many levels of symbolic links");
    check(name + ".glb", "File name too long");
    CHECK(folder.files() == 1);
}

TEST_CASE("no file of a render replaces another, whatever it is called") {
    const TemporaryFolder folder("tool_twins");
    std::filesystem::create_directory(folder / "a");
    std::filesystem::create_directory_symlink("a", folder / "b");
    const auto refused = [&](const Words& more) {
        check_failure(run_mir(small_render(folder / "a/x.exr") + more), 2);
    };
    const Words resume{"--resume", "--passes", "2"};
    const auto file = [&](const char* name) { return (folder / name).string(); };
    refused(Words{"--png", file("a/x.exr.journal")} + resume);
    refused(Words{"--png", file("b/x.exr.journal")} + resume);
    refused(Words{"--report", file("a/../a/x.exr.journal")} + resume);
    refused({"--report", file("b/x.png")});
    write_file(folder / "a/y.png", "");
    std::filesystem::create_hard_link(folder / "a/y.png", folder / "z.html");
    refused({"--png", file("a/y.png"), "--report", file("z.html")});
    CHECK(run_mir(small_render(folder / "a/x.exr") + resume).exit_code == 0);
}

TEST_CASE("picture and preview cannot be one file") {
    const TemporaryFolder folder("tool_one_file");
    const std::string there = (folder / "").string();
    const Words scene{"render", "builtin:sphere"};
    check_failure(run_mir(scene + Words{"-o", there + "a.png"}), 2, "same");
    check_failure(run_mir(scene + Words{"-o", there + "a.exr", "--png", there + "./a.exr"}), 2,
                  "same");
    CHECK(folder.files() == 0);
}

TEST_CASE("every malformed shared file is refused in one line") {
    const auto scenes = shared_scenes();
    if (!scenes || !std::filesystem::exists(*scenes / "malformed")) {
        WARN("the shared folder 'malformed' is not on this machine; skipped");
        return;
    }
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(*scenes / "malformed")) {
        if (entry.path().extension() != ".gltf") continue;
        check_refused(entry.path().string(), entry.path().filename().string());
        ++files;
    }
    CHECK(files == 9);
}

TEST_CASE("remarks on a scene are left out when it cannot be rendered") {
    const auto scenes = shared_scenes();
    const char* name = "gltf-features/09_texture_transform/09_texture_transform.gltf";
    if (!scenes || !std::filesystem::exists(*scenes / name)) {
        WARN("the shared scene '" << name << "' is not on this machine; skipped");
        return;
    }
    check_failing_render({(*scenes / name).string()}, 3, "has no light");
}
