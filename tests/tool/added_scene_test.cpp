// SPDX-License-Identifier: MIT
#include "tool/exr_file.hpp"
#include "tool/mir_program.hpp"

#include <fstream>
#include <numbers>

using namespace mirtest;

namespace {

/// A triangle of 2 cm, faced up, in a file without light and camera.
struct BareObject {
    TemporaryFolder folder{"added_scene"};
    std::string scene = (folder / "bare.obj").string();
    std::string picture = (folder / "a.exr").string();

    BareObject() { std::ofstream(scene) << "v -1 5 -1\nv 0 5 1\nv 1 5 -1\nf 1 2 3\n"; }

    /// Direct light of a picture that looks at the ground beside the triangle, which is at its
    /// height.
    [[nodiscard]] mir::Image<mir::Rgb> ground(const Words& more) const {
        const Words view{"--ground", "--eye", "6,8,3", "--look-at", "6,5,0",
                         "--fov",    "20",    "--aov", "direct"};
        REQUIRE(run_mir(small_render(picture, scene) + view + more).exit_code == 0);
        return mir::read_exr(picture, "direct").image;
    }
};

}  // namespace

TEST_CASE("a ground under a sun has the radiance of its reflectance and its irradiance", "[slow]") {
    const BareObject bare;
    // Irradiance E cos over pi, times the reflectance 1/2.
    for (const auto& [sun, cosine] :
         {std::pair{"0,7,0", 1.0}, std::pair{"3,4,0", 0.8}, std::pair{"-4,3,0", 0.6}}) {
        INFO(sun);
        const auto direct = bare.ground({"--sun", sun, "--sun-irradiance", "2"});
        for (const mir::Rgb& pixel : direct.pixels())
            CHECK(static_cast<double>(pixel.g) ==
                  Approx(2.0 * cosine * 0.5 / std::numbers::pi).epsilon(1e-4));
    }
}

TEST_CASE("a sun below the ground lights nothing of it") {
    const BareObject bare;
    const auto direct = bare.ground({"--sun", "0,-1,0"});
    for (const mir::Rgb& pixel : direct.pixels()) CHECK(mir::is_black(pixel));
}

TEST_CASE("a camera that is chosen looks at what stands on the ground, not at the ground") {
    const BareObject bare;
    const Words words = small_render(bare.picture, bare.scene) + Words{"--sun", "1,2,1"};
    const auto picture = [&](const Words& more) {
        REQUIRE(run_mir(words + more).exit_code == 0);
        return mir::read_exr(bare.picture, "depth").image;
    };
    const auto alone = picture({});
    const auto grounded = picture({"--ground"});
    REQUIRE(alone(12, 9).r > 0.0f);
    CHECK(grounded(12, 9).r == Approx(alone(12, 9).r).epsilon(1e-3));
}

TEST_CASE("the camera of --eye looks at the middle of the scene, straight down too") {
    const BareObject bare;
    const Words sun{"--sun", "1,2,1"};
    for (const char* eye : {"0,8,6", "0,9,0", "0.0001,1,0"}) {
        INFO(eye);
        const Words look = small_render(bare.picture, bare.scene) + sun + Words{"--eye", eye};
        REQUIRE(run_mir(look).exit_code == 0);
        // The triangle is around the middle of the picture, and not at its corners.
        const auto depth = mir::read_exr(bare.picture, "depth").image;
        CHECK(depth(12, 9).r > 0.0f);
        CHECK(depth(0, 0).r == 0.0f);
        CHECK(depth(23, 17).r == 0.0f);
    }
}

TEST_CASE("suns and cameras without direction are refused") {
    const BareObject bare;
    const auto refused = [&](const Words& more, const std::string& says) {
        check_failing_render(Words{bare.scene} + more, 2, says);
    };
    refused({"--sun", "0,0,0"}, "in no direction");
    refused({"--sun", "1,2"}, "'1,2' is no vector");
    refused({"--sun", "1,2,nan"}, "is no vector");
    refused({"--sun", "1,2,1", "--eye", "1,2,3", "--look-at", "1,2,3"}, "has no direction");
    refused({"--look-at", "1,2,3"}, "--look-at requires --eye");
    refused({"--sun-irradiance", "1"}, "--sun-irradiance requires --sun");
    refused({"--eye", "1,2,3", "--camera", "0"}, "excludes");
}
