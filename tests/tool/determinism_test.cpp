// SPDX-License-Identifier: MIT
#include "tool/mir_program.hpp"

using namespace mirtest;

namespace {

/// Bytes of the EXR of a small render with several bands of tiles, luxels and every layer.
std::string picture(const Words& more, const std::string& scene = "builtin:sphere-indirect") {
    const TemporaryFolder folder("determinism");
    const Words all{"--luxels", "3", "--aov",
                    "albedo,normal,position,depth,direct,indirect,emission,bounces"};
    const Outcome outcome = run_mir(small_render(folder / "a.exr", scene, 70, 50) + all + more);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return file_bytes(folder / "a.exr");
}

}  // namespace

TEST_CASE("the bytes of a picture do not depend on threads, tiles, scheduler or the run") {
    const std::string scene = GENERATE("builtin:sphere-indirect", "builtin:furnace");
    const std::string expected = picture({}, scene);
    REQUIRE(expected.size() > 10000);
    for (const Words& same :
         {Words{}, Words{"--threads", "1"}, Words{"--threads", "2"}, Words{"--threads", "7"},
          Words{"--tile", "16x16"}, Words{"--tile", "64x64"}, Words{"--tile", "80x160"},
          Words{"--tile", "33x17"}, Words{"--tile", "16"}, Words{"--scheduler", "cpu"},
          Words{"--scheduler", "cpu-blocks"},
          Words{"--scheduler", "cpu", "--tile", "64x64", "--threads", "1"}}) {
        INFO((same.empty() ? std::string("again") : same[0] + " " + same[1]));
        CHECK((picture(same, scene) == expected));
    }
}

TEST_CASE("the bytes do not depend on threads or scheduler for any way to place VPLs") {
    for (const Words& way :
         {Words{"--sampler", "keller"}, Words{"--sequence", "halton"}, Words{"--direct", "vpl"},
          Words{"--bound", "none"}, Words{"--bound", "0.5"}, Words{"--filter", "box"}}) {
        INFO(way[0] << " " << way[1]);
        const std::string expected = picture(way + Words{"--threads", "1"});
        CHECK((picture(way + Words{"--threads", "2"}) == expected));
        CHECK((picture(way + Words{"--scheduler", "cpu"}) == expected));
    }
}

TEST_CASE("another seed gives another picture") {
    CHECK((picture({"--seed", "1"}) != picture({"--seed", "2"})));
    CHECK((picture({"--seed", "0"}) == picture({})));
}

TEST_CASE("two renders at once into one folder do not disturb each other") {
    const TemporaryFolder folder("determinism_at_once");
    RunningProgram first(mir_command(small_render(folder / "a.exr")));
    RunningProgram second(mir_command(small_render(folder / "b.exr")));
    CHECK(first.wait().exit_code == 0);
    CHECK(second.wait().exit_code == 0);
    CHECK((file_bytes(folder / "a.exr") == file_bytes(folder / "b.exr")));
    CHECK(folder.files() == 4);
}
