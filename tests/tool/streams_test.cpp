// SPDX-License-Identifier: MIT
#include "tool/mir_program.hpp"

#include <filesystem>
#include <fstream>
#include <string>

using namespace mirtest;

namespace {

/// Runs `mir ARGUMENTS` by a shell; `before` comes before it, `behind` behind it.
Outcome run_in_shell(const std::string& before, const Words& arguments, const std::string& behind) {
    const std::string line = before + R"( exec "$0" "$@" )" + behind;
    return RunningProgram(Words{"/bin/sh", "-c", line, MIR_TOOL} + arguments).wait();
}

}  // namespace

TEST_CASE("what is meant for a closed stream is not written into a picture") {
    const TemporaryFolder folder("tool_closed");
    const std::string exr = (folder / "a.exr").string();
    REQUIRE(run_mir(small_render(folder / "b.exr")).exit_code == 0);
    for (const char* closed : {"2>&-", ">&-", "<&-", "<&- >&- 2>&-"}) {
        INFO(closed);
        Words loud = small_render(exr);
        loud.pop_back();
        CHECK(run_in_shell("", loud, closed).exit_code == 0);
        CHECK(file_bytes(exr) == file_bytes(folder / "b.exr"));
        CHECK(file_bytes(folder / "a.png") == file_bytes(folder / "b.png"));
    }
}

TEST_CASE("results that cannot be written are a failure") {
    for (const Words& command :
         {Words{"--help"}, Words{"render", "--help"}, Words{"--version"}, Words{"devices"},
          Words{"info", "builtin:furnace"}, Words{"info", "builtin:furnace", "--json"}})
        check_failure(run_in_shell("", command, ">/dev/full"), 1,
                      "standard output cannot be written (");
}

TEST_CASE("a picture that becomes too large is an error and leaves nothing") {
    const TemporaryFolder folder("tool_too_large");
    const Words render = small_render(folder / "a.exr", "builtin:cornell-box", 200, 200);
    // 512 bytes or a KiB each.
    check_failure(run_in_shell("ulimit -f 8;", render, ""), 1, "File too large");
    CHECK(folder.files() == 0);
}

TEST_CASE("a picture that only its owner may read stays so") {
    const TemporaryFolder folder("tool_private");
    const auto owner_alone = std::filesystem::perms(0600);
    std::ofstream(folder / "a.exr") << "older picture";
    std::filesystem::permissions(folder / "a.exr", owner_alone);
    REQUIRE(run_mir(small_render(folder / "a.exr")).exit_code == 0);
    CHECK(std::filesystem::status(folder / "a.exr").permissions() == owner_alone);
}
