// SPDX-License-Identifier: MIT
#include "tool/mir_program.hpp"

#include <chrono>
#include <thread>

using namespace mirtest;

namespace {

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr std::chrono::seconds patience(60);  // sanitized programs run many times slower
#else
constexpr std::chrono::seconds patience(5);
#endif

/// Sends `signal` to a long render after a second and checks that it left no trace.
void check_interrupted(int signal, const Words& work) {
    const TemporaryFolder folder("interrupt");
    std::ofstream(folder / "a.exr") << "older picture";
    RunningProgram render(mir_command(
        Words{"render", "builtin:sphere-indirect", "--quiet", "-o", folder / "a.exr"} + work));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    render.send(signal);
    const auto sent = std::chrono::steady_clock::now();
    check_failure(render.wait(), 130, "cancelled");
    // More work than that is left; this is the patience of whoever pressed the key.
    CHECK(std::chrono::steady_clock::now() - sent < patience);
    CHECK(file_bytes(folder / "a.exr") == "older picture");
    CHECK(folder.files() == 1);
}

}  // namespace

TEST_CASE("Ctrl-C ends a render with code 130 and leaves no file behind") {
    const std::string scheduler = GENERATE("cpu-blocks", "cpu");
    check_interrupted(SIGINT, {"--vpls", "20000", "--scheduler", scheduler});
}

TEST_CASE("Ctrl-C is heard while camera rays are traced") {
    check_interrupted(SIGINT, {"--luxels", "64", "--vpls", "10000"});
}

TEST_CASE("Ctrl-C is heard while direct light is sampled") {
    check_interrupted(SIGINT, {"--direct-samples", "512"});
}

TEST_CASE("a request to terminate is answered like Ctrl-C") {
    check_interrupted(SIGTERM, {"--vpls", "20000"});
}
