// SPDX-License-Identifier: MIT
#include "mir/scenes.hpp"
#include "mir/version.hpp"
#include "tool/mir_program.hpp"

using namespace mirtest;

TEST_CASE("help goes to standard output, also that of each command") {
    for (const Words& command :
         {Words{}, Words{"render"}, Words{"info"}, Words{"export"}, Words{"compare"},
          Words{"denoise"}, Words{"devices"}, Words{"manual"}}) {
        const Outcome help = run_mir(command + Words{"--help"});
        CHECK(help.exit_code == 0);
        CHECK(has(help.out, "Usage: mir"));
        CHECK(help.err.empty());
    }
}

TEST_CASE("the version is that of the headers") {
    const Outcome version = run_mir({"--version"});
    CHECK(version.exit_code == 0);
    CHECK(version.out.rfind("mir " + std::string(mir::version) + " (", 0) == 0);
    CHECK(version.err.empty());
}

TEST_CASE("a command is required and mistyped ones are recognised") {
    check_failure(run_mir({}), 2, "no command is given (commands are render, merge, info,");
    check_failure(run_mir({"convert", "a.glb"}), 2, "unknown command 'convert'");
    check_failure(run_mir({"rendr", "builtin:sphere"}), 2, "did you mean render?");
    check_failure(run_mir({"render"}), 2, "scene is required");
    check_failure(run_mir({"info"}), 2, "scene is required");
    check_failure(run_mir({"export", "builtin:sphere"}), 2, "--output is required");
    check_failing_render({"builtin:sphere", "builtin:sphere"}, 2, "builtin:sphere");
}

TEST_CASE("a number that begins with a zero is no octal one") {
    for (const char* option : {"--width", "--vpls", "--seed", "--bounces", "--threads"})
        for (const char* number : {"010", "0100", "0x10", "00"}) {
            INFO(option << " " << number);
            check_failing_render({"builtin:furnace", option, number}, 2, "begins with a zero");
        }
    const TemporaryFolder folder("tool_zero");
    const Words zeros{"--seed", "0", "--exposure", "0.5", "--threads", "0"};
    CHECK(run_mir(small_render(folder / "a.exr") + zeros).exit_code == 0);
}

TEST_CASE("an unknown option names the nearest one") {
    check_failing_render({"builtin:sphere", "--vlps", "3"}, 2, "did you mean --vpls?");
    check_failing_render({"builtin:sphere", "--sede=3"}, 2, "did you mean --seed?");
    check_failing_render({"builtin:sphere", "--widht", "3"}, 2, "did you mean --width?");
    check_failure(run_mir({"stranger", "info", "builtin:sphere"}), 2,
                  "unknown argument 'stranger'");
    check_failure(run_mir({"info", "builtin:sphere", "--jsno"}), 2, "did you mean --json?");
}

TEST_CASE("an unknown option that resembles none is named without a guess") {
    const Outcome outcome = run_mir({"render", "builtin:sphere", "--nonsense-of-mine"});
    check_failure(outcome, 2, "--nonsense-of-mine");
    CHECK_FALSE(has(outcome.err, "did you mean"));
    // Two of its four letters would have to change.
    CHECK_FALSE(has(run_mir({"render", "builtin:sphere", "--size", "3"}).err, "did you mean"));
}

TEST_CASE("no layers and a layer contradict each other") {
    check_failing_render({"builtin:sphere", "--aov", "none,albedo"}, 2, "none goes with no other");
}

TEST_CASE("values out of range are refused before any work") {
    for (const Words& wrong : {Words{"--vpls", "0"},
                               Words{"--vpls", "1000000000"},
                               Words{"--vpls", "-3"},
                               Words{"--vpls", "many"},
                               Words{"--vpls", "nan"},
                               Words{"--width", "0"},
                               Words{"--height", "0"},
                               Words{"--width", "65537"},
                               Words{"--luxels", "0"},
                               Words{"--luxels", "65"},
                               Words{"--direct-samples", "0"},
                               Words{"--direct-samples", "65537"},
                               Words{"--bounces", "0"},
                               Words{"--bounces", "255"},
                               Words{"--threads", "1025"},
                               Words{"--threads", "-1"},
                               Words{"--seed", "-1"},
                               Words{"--seed", "18446744073709551616"},
                               Words{"--exposure", "bright"},
                               Words{"--exposure", "nan"},
                               Words{"--bound", "0"},
                               Words{"--bound", "-1"},
                               Words{"--bound", "nan"},
                               Words{"--bound", "inf"},
                               Words{"--bound", "large"},
                               Words{"--passes", "0"},
                               Words{"--vsl-samples", "0"},
                               Words{"--vsl-scale", "0"},
                               Words{"--glossy-roughness", "2"},
                               Words{"--glossy-roughness", "-1"},
                               Words{"--compensate", "-1"},
                               Words{"--compensate", "65537"},
                               Words{"--passes", "1000001"},
                               Words{"--passes", "1.5"},
                               Words{"--time", "0"},
                               Words{"--time", "-1"},
                               Words{"--time", "nan"},
                               Words{"--target-error", "0"},
                               Words{"--target-error", "2"},
                               Words{"--target-error", "small"},
                               Words{"--save-every", "-1"}}) {
        INFO(wrong[0] << " " << wrong[1]);
        check_failing_render(Words{"builtin:sphere"} + wrong, 2, wrong[0]);
    }
}

TEST_CASE("goals that no pass can reach are refused by option, value, reason and remedy") {
    struct Goal {
        const char* option;
        std::vector<const char*> values;
        const char* rest;
    };
    for (const Goal& goal :
         {Goal{"--target-error",
               {"0", "-0", "-0.01", "nan", "1e-9", "-inf"},
               " is out of range (the mean of passes comes near the true picture, but never to "
               "it); give 0.000001 to 1"},
          Goal{"--time",
               {"0", "-1", "nan", "0.0001"},
               " is out of range (a pass takes some time); give 0.001 to 32000000"},
          Goal{"--passes",
               {"0", "-1", "nan"},
               " is out of range (without a pass there is no picture); give 1 to 1000000"}})
        for (const char* value : goal.values) {
            INFO(goal.option << " " << value);
            check_failing_render({"builtin:sphere", std::string(goal.option) + "=" + value}, 2,
                                 std::string(goal.option) + ": " + value + goal.rest);
        }
    check_failing_render({"builtin:sphere", "--target-error", "inf"}, 2,
                         "--target-error: inf is out of range; give 0.000001 to 1");
}

TEST_CASE("the path tracer, which has no bound, refuses one") {
    const Words path{"builtin:sphere", "--integrator", "path"};
    check_failing_render(path + Words{"--bound", "2"}, 2, "--bound");
    for (const char* none : {"auto", "none"}) {
        const TemporaryFolder folder("tool_path_bound");
        const Words small = small_render(folder / "a.exr") +
                            Words{"--integrator", "path", "--samples", "1", "--bound", none};
        CHECK(run_mir(small).exit_code == 0);
    }
}

TEST_CASE("options of passes that contradict each other are refused") {
    check_failing_render({"builtin:sphere", "--passes", "1", "--target-error", "0.1"}, 2,
                         "a target error and a single pass");
    check_failing_render({"builtin:sphere", "--save-every", "1"}, 2, "--save-every was given for");
    check_failing_render({"builtin:sphere", "--passes", "1", "--time", "3", "--save-every", "1"}, 2,
                         "--save-every was given for");
}

TEST_CASE("a tile is two positive numbers and nothing more") {
    for (const char* tile : {"0x16", "16x0", "16x", "x16", "16x16x16", "16x16 ", "-1x16", "16abc",
                             "16 16", "65537x1", ""}) {
        INFO(tile);
        check_failing_render({"builtin:sphere", std::string("--tile=") + tile}, 2, "--tile");
    }
}

TEST_CASE("a tile larger than the image of luxels is refused, one as large as it is not") {
    const TemporaryFolder folder("tool_tile");
    for (const char* tile : {"81x32", "16x177", "256x256"}) {
        INFO(tile);
        const Outcome outcome = run_mir(small_render(folder / "a.exr", "builtin:sphere", 70, 50) +
                                        Words{"--luxels", "3", "--tile", tile});
        CHECK(outcome.exit_code == 2);
        CHECK(has(outcome.err, "larger than the image, which has 70x150; use 80x160"));
        CHECK_FALSE(std::filesystem::exists(folder / "a.exr"));
    }
    const Outcome whole = run_mir(small_render(folder / "a.exr", "builtin:sphere", 70, 50) +
                                  Words{"--luxels", "3", "--tile", "80x160"});
    CHECK(whole.exit_code == 0);
}

TEST_CASE("unknown choices are refused with the list of known ones") {
    check_failing_render({"builtin:sphere", "--sampler", "bdpt"}, 2, "keller");
    check_failing_render({"builtin:sphere", "--sequence", "sobol"}, 2, "halton");
    check_failing_render({"builtin:sphere", "--direct", "never"}, 2, "separate");
    check_failing_render({"builtin:sphere", "--filter", "sinc"}, 2, "lanczos");
    check_failing_render({"builtin:sphere", "--scheduler", "gpu"}, 2, "cpu-blocks");
    for (const char* devices : {"0,", "first", "", "0,-1", "00", "0 1"})
        check_failing_render({"builtin:sphere", std::string("--devices=") + devices}, 2,
                             "--devices");
    check_failing_render({"builtin:sphere", "--devices", "0,1,0"}, 2, "chosen twice");
    check_failing_render({"builtin:sphere", "--aov", "albedo,shadow"}, 2, "albedo");
}

TEST_CASE("an image beyond the limit of pixels is refused") {
    check_failing_render({"builtin:sphere", "--width", "65536", "--height", "65536"}, 2, "pixels");
    check_failing_render({"builtin:sphere", "--width", "65536", "--height", "4096"}, 2,
                         "picture_bytes");
}

TEST_CASE("an unknown built-in scene is answered with the names of all") {
    const Outcome outcome = run_mir({"info", "builtin:teapot"});
    check_failure(outcome, 3);
    for (const auto& scene : mir::builtin::scenes) CHECK(has(outcome.err, std::string(scene.name)));
}

TEST_CASE("an unknown camera is answered with the names of all") {
    check_failing_render({"builtin:sphere", "--camera", "kitchen"}, 2, "'room'");
    check_failing_render({"builtin:sphere", "--camera", "1"}, 2, "'room'");
}
