// SPDX-License-Identifier: MIT
#include "tool/exr_file.hpp"
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

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

TEST_CASE("Ctrl-C between passes keeps the picture of those done, marked incomplete") {
    const TemporaryFolder folder("interrupt_passes");
    const std::filesystem::path exr = folder / "a.exr";
    RunningProgram render(mir_command(small_render(exr) +
                                      Words{"--passes", "1000000", "--json", "--save-every", "0"}));
    wait_for(exr);
    render.send(SIGINT);
    const Outcome outcome = render.wait();
    CHECK(outcome.exit_code == 130);
    REQUIRE(lines_of(outcome.err).size() == 1);
    CHECK(has(outcome.err, "mir: interrupted"));
    const auto json = nlohmann::json::parse(outcome.out);
    CHECK(json.at("complete") == false);
    CHECK(attribute_of(exr, "mir:complete") == "0");
    const std::string passes = attribute_of(exr, "mir:passes");
    CHECK(json.at("passes") == std::stoi(passes));
    CHECK(folder.files() == 2);
    // What is there is what so many passes give.
    const std::filesystem::path same = folder / "b.exr";
    REQUIRE(run_mir(small_render(same) + Words{"--passes", passes}).exit_code == 0);
    for (const std::string& layer : layers_of(exr))
        CHECK(largest_difference(mir::read_exr(exr, layer).image,
                                 mir::read_exr(same, layer).image) == 0.0f);
    CHECK(attribute_of(same, "mir:complete") == "1");
    CHECK(attribute_of(same, "mir:relative_error") == attribute_of(exr, "mir:relative_error"));
}

TEST_CASE("Ctrl-C in the first of several passes leaves no file behind") {
    check_interrupted(SIGINT, {"--vpls", "20000", "--passes", "100"});
}
