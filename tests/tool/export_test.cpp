// SPDX-License-Identifier: MIT
#include "mir/scenes.hpp"
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

using namespace mirtest;

namespace {

nlohmann::json counts_of(const std::string& scene) {
    return nlohmann::json::parse(run_mir({"info", scene, "--json"}).out).at("counts");
}

}  // namespace

TEST_CASE("every built-in scene is exported and holds the same when read again") {
    const TemporaryFolder folder("export");
    for (const auto& entry : mir::builtin::scenes) {
        const std::string scene = "builtin:" + std::string(entry.name);
        const std::string file = (folder / (std::string(entry.name) + ".glb")).string();
        INFO(scene);
        const Outcome outcome = run_mir({"export", scene, "-o", file});
        CHECK(outcome.exit_code == 0);
        CHECK(outcome.err.empty());
        CHECK(outcome.out == file + "\n");
        CHECK(counts_of(file) == counts_of(scene));
    }
    CHECK(folder.files() == mir::builtin::scenes.size());
}

TEST_CASE("an exported scene renders to the same picture, name aside") {
    const TemporaryFolder folder("export_render");
    const std::string scene = (folder / "box.glb").string();
    REQUIRE(run_mir({"export", "builtin:cornell-box", "-o", scene}).exit_code == 0);
    REQUIRE(run_mir(small_render(folder / "built_in.exr")).exit_code == 0);
    REQUIRE(run_mir(small_render(folder / "exported.exr", scene)).exit_code == 0);
    CHECK(file_bytes(folder / "built_in.png") == file_bytes(folder / "exported.png"));
}

TEST_CASE("an export that fails leaves the older file as it was") {
    const TemporaryFolder folder("export_failing");
    const std::string file = (folder / "a.glb").string();
    std::ofstream(folder / "a.glb") << "older scene";
    check_failure(run_mir({"export", "builtin:teapot", "-o", file}), 3);
    check_failure(run_mir({"export", "missing.glb", "-o", file}), 3, "missing.glb");
    check_failure(run_mir({"export", "missing.glb", "-o", "./missing.glb"}), 2, "replace");
    CHECK(file_bytes(folder / "a.glb") == "older scene");
    check_failure(run_mir({"export", "builtin:sphere", "-o", (folder / "none/a.glb").string()}), 1,
                  "none/a.glb");
    CHECK(folder.files() == 1);
}
