// SPDX-License-Identifier: MIT
#include "tool/help_text.hpp"

#include <algorithm>
#include <fstream>

using namespace mirtest;

namespace {

std::string manual(const char* language) {
    const Outcome outcome = run_mir({"manual", language});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    return outcome.out;
}

Outcome shell(const std::string& line, const std::filesystem::path& folder = ".") {
    return RunningProgram(Words{"/bin/sh", "-c", line}, folder).wait();
}

bool has_program(const std::string& name) {
    if (shell("command -v " + name).exit_code == 0) return true;
    WARN(name << " is not on this machine; skipped");
    return false;
}

std::string without(std::string text, const std::string& what) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos;)
        text.erase(at, what.size());
    return text;
}

/// A folder with the completion of bash and two files.
struct Bash {
    TemporaryFolder folder{"tool_completion"};

    Bash() {
        std::ofstream(folder / "mir.bash") << manual("bash");
        for (const char* scene : {"room.glb", "room of mine.glb"})
            std::ofstream(folder / scene) << "a scene";
    }

    /// What bash offers for the last of these words, as bash splits a line.
    [[nodiscard]] Words offers(const Words& line) const {
        std::string words;
        for (const std::string& word : line) words += " '" + word + "'";
        const std::string script = "set -u; source ./mir.bash; COMP_WORDS=(" + words +
                                   "); COMP_CWORD=" + std::to_string(line.size() - 1) +
                                   "; _mir mir; ((${#COMPREPLY[@]})) && "
                                   "printf '%s\\n' \"${COMPREPLY[@]}\" || true";
        const Outcome outcome =
            RunningProgram({"/bin/bash", "--norc", "-c", script}, folder / ".").wait();
        INFO(outcome.err);
        CHECK(outcome.exit_code == 0);
        CHECK(outcome.err.empty());
        return lines_of(outcome.out);
    }
};

}  // namespace

TEST_CASE("the manual page names every option of every command") {
    const std::string page = without(manual("man"), "\\");
    for (const std::string& command : tool_commands) {
        CHECK(has(page, "fBmir " + command));
        for (const std::string& option : options_of(command)) {
            INFO(command << " " << option);
            CHECK(has(page, "fB" + option + "fR"));
        }
    }
    for (const char* code : {"0", "1", "2", "3", "4", "130"})
        CHECK(has(page, std::string("fB") + code + "fR\n"));
}

TEST_CASE("the manual page is set without warnings") {
    const TemporaryFolder folder("tool_manual");
    std::ofstream(folder / "mir.1") << manual("man");
    if (has_program("groff")) {
        const Outcome set = shell("groff -man -Tutf8 -ww -z mir.1", folder / ".");
        CHECK(set.exit_code == 0);
        CHECK(set.err.empty());
    }
    if (has_program("mandoc")) {
        const Outcome lint = shell("mandoc -T lint -W error mir.1", folder / ".");
        CHECK(lint.out + lint.err == "");
    }
}

TEST_CASE("bash completes every command and every option") {
    if (!has_program("bash")) return;
    const Bash bash;
    const Words commands = bash.offers({"mir", ""});
    for (const std::string& command : tool_commands) {
        CHECK(std::find(commands.begin(), commands.end(), command) != commands.end());
        const Words offered = bash.offers({"mir", command, "--"});
        for (const std::string& option : options_of(command)) {
            INFO(command << " " << option);
            CHECK(std::find(offered.begin(), offered.end(), option) != offered.end());
        }
    }
    CHECK(bash.offers({"mir", "--v"}) == Words{"--version"});
    CHECK(bash.offers({"mir", "ren"}) == Words{"render"});
}

TEST_CASE("bash completes values, also behind an equals sign and a comma") {
    if (!has_program("bash")) return;
    const Bash bash;
    const Words backends{"auto", "cpu", "cuda"};
    CHECK(bash.offers({"mir", "render", "room.glb", "--backend", ""}) == backends);
    CHECK(bash.offers({"mir", "render", "--backend", "="}) == backends);
    CHECK(bash.offers({"mir", "render", "--backend", "=", "cp"}) == Words{"cpu"});
    CHECK(bash.offers({"mir", "render", "--aov", "albedo,no"}) ==
          Words{"albedo,normal", "albedo,none"});
    CHECK(bash.offers({"mir", "render", "--width", ""}).empty());
    CHECK(bash.offers({"mir", "manual", "z"}) == Words{"zsh"});
}

TEST_CASE("bash completes files and scenes that are built in") {
    if (!has_program("bash")) return;
    const Bash bash;
    Words rooms = bash.offers({"mir", "render", "ro"});
    std::sort(rooms.begin(), rooms.end());
    CHECK(rooms == Words{"room of mine.glb", "room.glb"});
    CHECK(bash.offers({"mir", "render", "-o", "room."}) == Words{"room.glb"});
    CHECK(bash.offers({"mir", "info", "bui"}) == Words{"builtin:"});
    CHECK(bash.offers({"mir", "info", "builtin", ":", "furn"}) == Words{"furnace"});
    CHECK(bash.offers({"mir", "info", "builtin", ":"}).size() >= 15);
}

TEST_CASE("zsh and fish take their completions, and fish completes options") {
    const TemporaryFolder folder("tool_shells");
    std::ofstream(folder / "_mir") << manual("zsh");
    std::ofstream(folder / "mir.fish") << manual("fish");
    if (has_program("zsh")) {
        const Outcome read = shell("zsh -n _mir", folder / ".");
        CHECK(read.exit_code == 0);
        CHECK(read.err.empty());
    }
    if (has_program("fish")) {
        const Outcome offered =
            shell("HOME=. fish --no-config -c 'source mir.fish; complete -C \"mir render --back\"'",
                  folder / ".");
        CHECK(offered.exit_code == 0);
        CHECK(has(offered.out, "--backend"));
    }
    for (const std::string& option : options_of("render")) {
        INFO(option);
        CHECK(has(file_bytes(folder / "_mir"), ")" + option));
        CHECK(has(file_bytes(folder / "mir.fish"), " -l " + option.substr(2) + " "));
    }
}
