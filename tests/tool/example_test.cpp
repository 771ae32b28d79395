// SPDX-License-Identifier: MIT
#include "tool/exr_file.hpp"
#include "tool/mir_program.hpp"

using namespace mirtest;

TEST_CASE("the example made of headers draws what the program draws, in every bit", "[extended]") {
    const TemporaryFolder folder("tool_example");
    RunningProgram example({MIR_COMPILE_TIME_EXAMPLE}, folder / "");
    REQUIRE(example.wait().exit_code == 0);
    const Words same{"render",           "builtin:sphere",
                     "--width",          "320",
                     "--height",         "240",
                     "--sampler",        "mir",
                     "--direct",         "vpl",
                     "--bound",          "1",
                     "--filter",         "box",
                     "--accel",          "embree",
                     "--vpls",           "1024",
                     "--luxels",         "1",
                     "--quiet",          "--aov",
                     "indirect",         "-o",
                     folder / "tool.exr"};
    REQUIRE(run_mir(same).exit_code == 0);
    const auto drawn = mir::read_exr(folder / "sphere.exr").image;
    CHECK(largest_difference(drawn, mir::read_exr(folder / "tool.exr", "indirect").image) == 0.0f);
}
