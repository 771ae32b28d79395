// SPDX-License-Identifier: MIT
#include "tool/exr_file.hpp"
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

using namespace mirtest;

namespace {

/// A small picture by the micro-rendering integrator.
Words small_micro(const std::filesystem::path& output) {
    return {"render",
            "builtin:cornell-box",
            "--width",
            "12",
            "--height",
            "12",
            "--surfels",
            "300",
            "--integrator",
            "micro",
            "--bounces",
            "3",
            "--surfel-rays",
            "8",
            "-o",
            output.string(),
            "--backend",
            "cpu",
            "-q"};
}

}  // namespace

TEST_CASE("every option of micro-rendering changes its picture, its default does not",
          "[extended]") {
    const TemporaryFolder folder("tool_micro");
    const auto picture = [&](const Words& choice) {
        const Outcome outcome = run_mir(small_micro(folder / "a.exr") + choice);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return mir::read_exr(folder / "a.exr").image;
    };
    const auto usual = picture({});
    for (const Words& same :
         {Words{"--gather-rays", "128"}, Words{"--gather-directions", "cosine"},
          Words{"--gather-threshold", "1"}, Words{"--threads", "1"}, Words{"--gather", "exact"},
          Words{"--buffer-size", "8"}, Words{"--gather-check", "correct"}}) {
        INFO(same[0] << " " << same[1]);
        CHECK(largest_difference(picture(same), usual) == 0.0f);
    }
    for (const Words& other :
         {Words{"--gather-rays", "64"}, Words{"--gather-directions", "uniform"},
          Words{"--gather", "rays"}, Words{"--seed", "1"}, Words{"--gather", "buffers"},
          Words{"--direct-samples", "4"}, Words{"--gather-check", "none"}}) {
        INFO(other[0] << " " << other[1]);
        CHECK(largest_difference(picture(other), usual) > 0.0f);
    }
}

TEST_CASE("rays that stop have a threshold") {
    const TemporaryFolder folder("tool_micro_threshold");
    const auto picture = [&](const char* threshold) {
        const Outcome outcome = run_mir(small_micro(folder / "a.exr") +
                                        Words{"--gather", "rays", "--gather-threshold", threshold});
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return mir::read_exr(folder / "a.exr").image;
    };
    CHECK(largest_difference(picture("20"), picture("1")) > 0.0f);
}

TEST_CASE("micro-buffers of a picture have a size and a threshold, and no rays") {
    const TemporaryFolder folder("tool_micro_buffers");
    const auto picture = [&](const Words& choice) {
        const Outcome outcome =
            run_mir(small_micro(folder / "a.exr") + Words{"--gather", "buffers"} + choice);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return mir::read_exr(folder / "a.exr").image;
    };
    const auto usual = picture({});
    CHECK(largest_difference(picture({"--buffer-size", "16", "--gather-rays", "7"}), usual) ==
          0.0f);
    CHECK(largest_difference(picture({"--buffer-size", "8"}), usual) > 0.0f);
    CHECK(largest_difference(picture({"--gather-threshold", "20"}), usual) > 0.0f);
}

TEST_CASE("glossy surfaces have a micro-buffer for their lobe where it is asked for") {
    const TemporaryFolder folder("tool_micro_warp");
    const auto picture = [&](const std::string& scene, const char* warp) {
        const Outcome outcome = run_mir(Words{"render",
                                              scene,
                                              "--integrator",
                                              "micro",
                                              "--surfels",
                                              "300",
                                              "--width",
                                              "12",
                                              "--height",
                                              "12",
                                              "--direct-samples",
                                              "1",
                                              "--gather",
                                              "buffers",
                                              "--buffer-size",
                                              "6",
                                              "--buffer-warp",
                                              warp,
                                              "-o",
                                              folder / "a.exr"});
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return mir::read_exr(folder / "a.exr").image;
    };
    const std::string diffuse = "builtin:cornell-box";
    CHECK(largest_difference(picture(diffuse, "importance"), picture(diffuse, "hemisphere")) ==
          0.0f);
    std::ofstream(folder / "a.mtl") << "newmtl steel\nKd 0.8 0.8 0.8\nPr 0.4\nPm 1\n"
                                       "newmtl lamp\nKe 5 5 5\n";
    std::ofstream(folder / "a.obj") << "mtllib a.mtl\n"
                                       "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\n"
                                       "v -1 2 -1\nv 1 2 -1\nv 0 1 0\nv 0.2 1 0\nv 0 1 -0.2\n"
                                       "usemtl steel\nf 1 2 3 4\nf 4 3 6 5\n"
                                       "usemtl lamp\nf 7 9 8\n";
    const std::string glossy = (folder / "a.obj").string();
    CHECK(largest_difference(picture(glossy, "importance"), picture(glossy, "hemisphere")) > 0.0f);
}

TEST_CASE("micro-rendering tells its number of discs and has a layer for each bounce") {
    const TemporaryFolder folder("tool_micro_json");
    const Outcome outcome =
        run_mir(small_micro(folder / "a.exr") + Words{"--json", "--aov", "bounces"});
    REQUIRE(outcome.exit_code == 0);
    const auto json = nlohmann::json::parse(outcome.out);
    CHECK(json["sampler"] == "micro");
    CHECK(json["surfels"] >= 300);
    CHECK(json["vpls"] == 0);
    CHECK(json["seconds"]["gather"] > 0.0);
    CHECK(json["mean_radiance"]["indirect"][0] > 0.0);
    CHECK(json["warnings"].empty());
}

TEST_CASE("options of micro-rendering out of range are usage errors") {
    for (const Words& wrong : {Words{"--surfels", "0"}, Words{"--gather-rays", "0"},
                               Words{"--gather-threshold", "-1"}, Words{"--surfel-rays", "65537"},
                               Words{"--gather-directions", "up"}, Words{"--gather", "discs"},
                               Words{"--buffer-size", "25"}, Words{"--buffer-warp", "lobe"}}) {
        INFO(wrong[0] << " " << wrong[1]);
        check_failing_render(Words{"builtin:sphere"} + wrong, 2, wrong[0]);
    }
    check_failing_render({"builtin:sphere", "--integrator", "micro", "--bound", "2"}, 2, "--bound");
}
