// SPDX-License-Identifier: MIT
#pragma once

#include "support/catch.hpp"
#include "tool/run_program.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace mirtest {

using Words = std::vector<std::string>;

inline Words operator+(Words a, const Words& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// The command `mir ARGUMENTS`.
inline Words mir_command(const Words& arguments) { return Words{MIR_TOOL} + arguments; }

/// Runs `mir ARGUMENTS` to its end. A check that fails next shows what a failed run said.
inline Outcome run_mir(const Words& arguments, const std::filesystem::path& folder = ".") {
    Outcome outcome = RunningProgram(mir_command(arguments), folder).wait();
    if (outcome.exit_code != 0) UNSCOPED_INFO("stderr: " << outcome.err);
    return outcome;
}

/// Arguments of a render without remarks that takes some milliseconds, on the processor whatever
/// else the machine has.
inline Words small_render(const std::filesystem::path& output,
                          const std::string& scene = "builtin:cornell-box", int width = 24,
                          int height = 18) {
    return {"render",    scene,
            "-o",        output.string(),
            "--width",   std::to_string(width),
            "--height",  std::to_string(height),
            "--vpls",    "16",
            "--backend", "cpu",
            "--quiet"};
}

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

inline bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Checks the manners of a failure: its exit code, nothing on standard output, one line that starts
/// with "mir: ", and after wrong usage a second one that tells where the help is.
inline void check_failure(const Outcome& outcome, int exit_code) {
    INFO("stderr: " << outcome.err);
    CHECK(outcome.exit_code == exit_code);
    CHECK(outcome.out.empty());
    std::vector<std::string> lines = lines_of(outcome.err);
    if (lines.size() == 2 && exit_code == 2) {
        CHECK(lines[1].rfind("mir: see 'mir", 0) == 0);
        lines.pop_back();
    }
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].rfind("mir: ", 0) == 0);
    CHECK(lines[0].size() > 20);
}

/// The same, and the message holds `part`.
inline void check_failure(const Outcome& outcome, int exit_code, const std::string& part) {
    check_failure(outcome, exit_code);
    INFO("stderr: " << outcome.err);
    CHECK(has(outcome.err, part));
}

/// Runs a render that must fail with `exit_code`, once where there is no output yet and once over
/// an older file: neither leaves or changes anything.
inline void check_failing_render(const Words& arguments, int exit_code,
                                 const std::string& part = "") {
    const TemporaryFolder folder("failing_render");
    const Words command = Words{"render"} + arguments + Words{"-o", (folder / "a.exr").string()};
    check_failure(run_mir(command), exit_code, part);
    CHECK(folder.files() == 0);
    std::ofstream(folder / "a.exr") << "older picture";
    std::ofstream(folder / "a.png") << "older preview";
    check_failure(run_mir(command), exit_code, part);
    CHECK(file_bytes(folder / "a.exr") == "older picture");
    CHECK(file_bytes(folder / "a.png") == "older preview");
    CHECK(folder.files() == 2);
}

}  // namespace mirtest
