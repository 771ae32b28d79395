// SPDX-License-Identifier: MIT
#include "io/gltf_fixture.hpp"
#include "support/test_sky.hpp"
#include "tool/exr_file.hpp"
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

using namespace mirtest;
using nlohmann::json;

namespace {

/// A floor without light, and a sky beside it.
class DarkFloor {
 public:
    DarkFloor() {
        write_file(scene(), "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4\n");
        put(constant_sky({0.5f, 1, 2}).radiance);
    }
    void put(const mir::Image<mir::Rgb>& radiance) const {
        mir::write_exr(sky(), radiance.extent(), {{"", &radiance}});
    }
    [[nodiscard]] std::string scene() const { return (folder_ / "floor.obj").string(); }
    [[nodiscard]] std::string sky() const { return (folder_ / "sky.exr").string(); }
    [[nodiscard]] std::string picture() const { return (folder_ / "out.exr").string(); }
    [[nodiscard]] Words under_sky() const {
        return small_render(picture(), scene()) + Words{"--environment", sky(), "--aov", "all"};
    }

 private:
    TemporaryFolder folder_{"environment"};
};

json json_of(const Words& arguments) {
    const Outcome outcome = run_mir(arguments + Words{"--json"});
    REQUIRE(outcome.exit_code == 0);
    return json::parse(outcome.out);
}

}  // namespace

TEST_CASE("info tells of the environment that a scene is given") {
    const DarkFloor floor;
    const json without = json_of({"info", floor.scene()});
    CHECK(without.at("counts").at("environments") == 0);
    CHECK(without.at("notes").dump().find("no light") != std::string::npos);
    CHECK_FALSE(without.contains("environment"));
    const Words given{"--environment", floor.sky(), "--environment-scale", "3"};
    const json with_sky = json_of(Words{"info", floor.scene()} + given);
    CHECK(with_sky.at("counts").at("environments") == 1);
    CHECK(with_sky.at("notes").dump().find("no light") == std::string::npos);
    CHECK(with_sky.at("scene_hash") != without.at("scene_hash"));
    const json& sky = with_sky.at("environment");
    CHECK(sky.at("file") == floor.sky());
    CHECK(sky.at("width") == 8);
    CHECK(sky.at("height") == 4);
    CHECK(sky.at("scale") == 3.0);
    CHECK(sky.at("rotation") == 0.0);
    CHECK(sky.at("mean_radiance")[0].get<double>() == Approx(1.5).epsilon(1e-3));
    CHECK(sky.at("mean_radiance")[2].get<double>() == Approx(6.0).epsilon(1e-3));
    CHECK(has(run_mir(Words{"info", floor.scene()} + given).out, "8 x 4, mean radiance 1.5"));
}

// The sky fills what the floor leaves; a floor of albedo 0.8 reflects 0.8 of it.
TEST_CASE("a scene without light is rendered under a sky, which is seen behind it") {
    const DarkFloor floor;
    check_failing_render({floor.scene(), "--quiet"}, 3, "no light");
    const json told = json_of(floor.under_sky());
    CHECK(told.at("environment").at("file") == floor.sky());
    CHECK(told.at("environment").at("scale") == 1.0);
    CHECK(told.at("emitted_power").get<double>() > 0.0);
    const mir::Image<mir::Rgb> behind = mir::read_exr(floor.picture(), "emission").image;
    CHECK(behind(0, 0).b == Approx(2.0f).epsilon(1e-3));
    const mir::Image<mir::Rgb> lit = mir::read_exr(floor.picture(), "direct").image;
    CHECK(lit(12, 9).g == Approx(0.8f).epsilon(0.25));
    static_cast<void>(json_of(floor.under_sky() + Words{"--direct", "vpl"}));
    const mir::Image<mir::Rgb> by_vpls = mir::read_exr(floor.picture(), "direct").image;
    CHECK(by_vpls(12, 9).g == Approx(0.8f).epsilon(0.25));
    const json brighter = json_of(floor.under_sky() + Words{"--environment-scale", "2"});
    const json turned = json_of(floor.under_sky() + Words{"--environment-rotation", "-90"});
    CHECK(brighter.at("scene_hash") != told.at("scene_hash"));
    CHECK(turned.at("scene_hash") != told.at("scene_hash"));
    CHECK(brighter.at("mean_radiance").at("emission")[1].get<double>() ==
          Approx(2.0 * told.at("mean_radiance").at("emission")[1].get<double>()).epsilon(1e-5));
}

TEST_CASE("environments that cannot be used are refused in one line") {
    const DarkFloor floor;
    check_failing_render({floor.scene(), "--environment", "missing.exr"}, 3, "missing.exr");
    check_failing_render({floor.scene(), "--environment", floor.scene()}, 3, "OpenEXR");
    check_failing_render({floor.scene(), "--environment-scale", "2"}, 2, "--environment");
    check_failing_render({floor.scene(), "--environment", floor.sky(), "--environment-scale", "-1"},
                         2, "--environment-scale");
    check_failing_render(
        {floor.scene(), "--environment", floor.sky(), "--environment-rotation", "999"}, 2,
        "-360 to 360");
    mir::Environment broken = constant_sky({1, 1, 1});
    broken.radiance(5, 2).g = -1.0f;
    floor.put(broken.radiance);
    check_failing_render({floor.scene(), "--environment", floor.sky()}, 3, "column 5, row 2");
    check_failure(run_mir({"info", floor.scene(), "--environment", floor.sky()}), 3, floor.sky());
    Words over = floor.under_sky();
    over[3] = floor.sky();
    check_failure(run_mir(over), 2);
}
