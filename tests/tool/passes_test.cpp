// SPDX-License-Identifier: MIT
#include "mir/core/random.hpp"
#include "mir/runtime/pass_seed.hpp"
#include "tool/exr_file.hpp"
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <thread>

using namespace mirtest;
using nlohmann::json;

namespace {

/// Renders with `more` arguments; returns the JSON.
json rendered(const std::filesystem::path& exr, const Words& more) {
    const Outcome outcome = run_mir(small_render(exr) + Words{"--json"} + more);
    REQUIRE(outcome.exit_code == 0);
    return json::parse(outcome.out);
}

}  // namespace

TEST_CASE("one pass gives the file of a plain render") {
    const TemporaryFolder folder("passes_one");
    const json plain = rendered(folder / "a.exr", {});
    CHECK(plain.at("passes") == 1);
    CHECK(plain.at("complete") == true);
    CHECK(plain.at("relative_error").is_null());
    CHECK(attribute_of(folder / "a.exr", "mir:passes") == "1");
    CHECK(attribute_of(folder / "a.exr", "mir:complete") == "1");
    CHECK(attribute_of(folder / "a.exr", "mir:relative_error") == "none");
    for (const Words& one : {Words{"--passes", "1"}, Words{"--time", "0.001"},
                             Words{"--passes", "1", "--time", "100"}}) {
        INFO(one[0]);
        rendered(folder / "b.exr", one);
        CHECK((file_bytes(folder / "a.exr") == file_bytes(folder / "b.exr")));
        CHECK((file_bytes(folder / "a.png") == file_bytes(folder / "b.png")));
    }
}

TEST_CASE("passes are the mean of renders with the seeds of pass_seed()") {
    const TemporaryFolder folder("passes_mean");
    rendered(folder / "mean.exr", {"--seed", "5", "--passes", "4", "--aov", "indirect"});
    mir::Image<mir::Rgb> mean({24, 18});
    for (std::uint64_t pass = 0; pass < 4; ++pass) {
        rendered(folder / "a.exr",
                 {"--seed", std::to_string(mir::pass_seed(5, pass)), "--aov", "indirect"});
        const mir::Image<mir::Rgb> one = mir::read_exr(folder / "a.exr", "indirect").image;
        for (std::size_t i = 0; i < mean.pixels().size(); ++i)
            mean.pixels()[i] += 0.25f * one.pixels()[i];
    }
    // Sums of four in single precision; passes add up in double.
    CHECK(largest_difference(mean, mir::read_exr(folder / "mean.exr", "indirect").image) < 1e-6f);
}

TEST_CASE("bytes of several passes do not depend on threads, or on saving in between") {
    const TemporaryFolder folder("passes_same");
    rendered(folder / "a.exr", {"--passes", "3"});
    for (const Words& same : {Words{"--threads", "1"}, Words{"--save-every", "0"},
                              Words{"--scheduler", "cpu", "--tile", "16x16"}}) {
        INFO(same[0]);
        rendered(folder / "b.exr", Words{"--passes", "3"} + same);
        CHECK((file_bytes(folder / "a.exr") == file_bytes(folder / "b.exr")));
    }
    CHECK(folder.files() == 4);
}

TEST_CASE("a target error ends the render, and the files say how far it got") {
    const TemporaryFolder folder("passes_error");
    // Luxels see the edge of the lamp in other places in every pass. With few of them little else
    // would be in the error of so small a picture, and 0.03 would take one luxel 20000 passes.
    const Words fine{"--luxels", "16"};
    const json all = rendered(folder / "a.exr", Words{"--target-error", "0.13"} + fine);
    CHECK(all.at("complete") == true);
    CHECK(all.at("passes") > 1);
    CHECK(all.at("relative_error") <= 0.13);
    CHECK(std::stoi(attribute_of(folder / "a.exr", "mir:passes")) == all.at("passes").get<int>());
    CHECK(std::stod(attribute_of(folder / "a.exr", "mir:relative_error")) ==
          Approx(all.at("relative_error").get<double>()).margin(1e-6));
    // The pass before was not good enough.
    const std::string fewer = std::to_string(all.at("passes").get<int>() - 1);
    const json before = rendered(folder / "b.exr", Words{"--passes", fewer} + fine);
    CHECK((fewer == "1" || before.at("relative_error") > 0.13));
}

TEST_CASE("a time limit stops after the pass in which it runs out") {
    const TemporaryFolder folder("passes_time");
    const auto begin = std::chrono::steady_clock::now();
    const json all = rendered(folder / "a.exr", {"--time", "0.3"});
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    CHECK(taken.count() >= 0.3);
    CHECK(all.at("complete") == true);
    CHECK(all.at("passes") >= 1);
    CHECK(all.at("seconds").at("total").get<double>() <= taken.count());
}

TEST_CASE("every integrator renders in passes") {
    const TemporaryFolder folder("passes_integrators");
    for (const Words& way : {Words{"--integrator", "path", "--samples", "2"},
                             Words{"--integrator", "micro", "--surfels", "64"}}) {
        const json all = rendered(folder / "a.exr", way + Words{"--passes", "2"});
        CHECK(all.at("passes") == 2);
        CHECK(all.at("relative_error") > 0.0);
    }
}

TEST_CASE("a summary tells passes and error, and so does a report") {
    const TemporaryFolder folder("passes_summary");
    Words loud =
        small_render(folder / "a.exr") + Words{"--passes", "2", "--report", folder / "a.html"};
    loud.erase(std::find(loud.begin(), loud.end(), "--quiet"));
    const Outcome outcome = run_mir(loud);
    CHECK(has(outcome.err, "mir: 2 passes, relative error "));
    CHECK(lines_of(outcome.out).size() == 3);
    CHECK(has(file_bytes(folder / "a.html"), "relative error, from their spread"));
}

TEST_CASE("killed at any moment, a render resumes to the bytes of one that never stopped",
          "[extended]") {
    const TemporaryFolder whole("passes_whole");
    const Words resumed{"--passes", "4", "--resume", "--save-every", "0"};
    const auto begin = std::chrono::steady_clock::now();
    rendered(whole / "a.exr", resumed);
    const std::chrono::duration<double> all = std::chrono::steady_clock::now() - begin;
    const std::string picture = file_bytes(whole / "a.exr");
    const std::string preview = file_bytes(whole / "a.png");
    mir::Random random(11, mir::Stream::test, 0);
    int equal = 0;
    int killed_later = 0;  // when some passes had been kept
    for (int kill = 0; kill < 20; ++kill) {
        const TemporaryFolder folder("passes_killed");
        RunningProgram render(mir_command(small_render(folder / "a.exr") + resumed));
        std::this_thread::sleep_for(all * static_cast<double>(random.next()));
        render.send(SIGKILL);
        CHECK(render.wait().exit_code != 1);
        if (std::filesystem::exists(folder / "a.exr"))
            CHECK_NOTHROW(mir::read_exr(folder / "a.exr"));
        if (std::filesystem::exists(folder / "a.exr.journal")) ++killed_later;
        REQUIRE(run_mir(small_render(folder / "a.exr") + resumed).exit_code == 0);
        if (file_bytes(folder / "a.exr") == picture && file_bytes(folder / "a.png") == preview)
            ++equal;
        // Picture, preview and journal: nothing that the killed process left over.
        CHECK(folder.files() == 3);
    }
    CHECK(equal == 20);
    CHECK(killed_later > 0);
}

TEST_CASE("a render that was killed again and again resumes to the same bytes, and on") {
    const TemporaryFolder folder("passes_resume");
    const Words passes{"--passes", "12"};
    rendered(folder / "whole.exr", passes);
    const Words resumed = passes + Words{"--resume", "--save-every", "0"};
    for (int moment = 0; moment < 5; ++moment) {
        RunningProgram render(mir_command(small_render(folder / "a.exr") + resumed));
        if (moment == 2) wait_for(folder / "a.exr.journal");
        std::this_thread::sleep_for(std::chrono::milliseconds(20 + 10 * moment));
        render.send(SIGKILL);
        CHECK(render.wait().exit_code != 1);
    }
    CHECK(std::filesystem::exists(folder / "a.exr.journal"));
    const json all = rendered(folder / "a.exr", resumed);
    CHECK(all.at("passes") == 12);
    CHECK((file_bytes(folder / "a.exr") == file_bytes(folder / "whole.exr")));
    // Once more: nothing is left to do. And then on, to more passes.
    rendered(folder / "a.exr", resumed);
    CHECK((file_bytes(folder / "a.exr") == file_bytes(folder / "whole.exr")));
    rendered(folder / "a.exr", {"--passes", "13", "--resume"});
    rendered(folder / "whole.exr", {"--passes", "13"});
    CHECK((file_bytes(folder / "a.exr") == file_bytes(folder / "whole.exr")));
}

TEST_CASE("passes with cuts go on from a journal to the same bytes, their luxels and errors too") {
    const TemporaryFolder folder("passes_cuts");
    const auto cuts_of = [](const char* picks) {
        return Words{"--sum", "cuts",     "--sampler", "ir",    "--picks",
                     picks,   "--luxels", "1",         "--aov", "indirect,pick_error"};
    };
    const Words cuts = cuts_of("4");
    rendered(folder / "whole.exr", cuts + Words{"--passes", "4"});
    rendered(folder / "a.exr", cuts + Words{"--passes", "2", "--resume"});
    rendered(folder / "a.exr", cuts + Words{"--passes", "3", "--resume", "--threads", "1"});
    rendered(folder / "a.exr", cuts + Words{"--passes", "4", "--resume", "--tile", "16"});
    CHECK((file_bytes(folder / "a.exr") == file_bytes(folder / "whole.exr")));
    CHECK((file_bytes(folder / "a.png") == file_bytes(folder / "whole.png")));
    CHECK(layers_of(folder / "a.exr") == std::set<std::string>{"", "indirect", "pick_error"});
    // Other picks are another render.
    check_failure(
        run_mir(small_render(folder / "a.exr") + cuts_of("5") + Words{"--passes", "5", "--resume"}),
        2, "a.exr.journal: the passes in it cannot be continued");
}

TEST_CASE("after Ctrl-C a render resumes without losing a pass") {
    const TemporaryFolder folder("passes_resume_interrupt");
    const std::filesystem::path journal = folder / "a.exr.journal";
    RunningProgram render(
        mir_command(small_render(folder / "a.exr") +
                    Words{"--passes", "1000000", "--resume", "--json", "--save-every", "0.05"}));
    wait_for(folder / "a.exr");
    render.send(SIGINT);
    const Outcome stopped = render.wait();
    REQUIRE(stopped.exit_code == 130);
    const int done = json::parse(stopped.out).at("passes");
    const Words as_many{"--passes", std::to_string(done)};
    const json all = rendered(folder / "a.exr", as_many + Words{"--resume"});
    CHECK(all.at("complete") == true);
    rendered(folder / "b.exr", as_many);
    CHECK((file_bytes(folder / "a.exr") == file_bytes(folder / "b.exr")));
    CHECK(std::filesystem::exists(journal));
}

TEST_CASE("a journal of another render is refused and nothing is changed") {
    const TemporaryFolder folder("passes_resume_other");
    rendered(folder / "a.exr", {"--passes", "2", "--resume"});
    const std::string picture = file_bytes(folder / "a.exr");
    const std::string journal = file_bytes(folder / "a.exr.journal");
    check_failure(
        run_mir(small_render(folder / "a.exr") + Words{"--passes", "2", "--resume", "--seed", "1"}),
        2, "a.exr.journal: the passes in it cannot be continued");
    CHECK((file_bytes(folder / "a.exr") == picture));
    CHECK((file_bytes(folder / "a.exr.journal") == journal));
}
