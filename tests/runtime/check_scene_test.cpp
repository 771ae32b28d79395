// SPDX-License-Identifier: MIT
#include "mir/runtime/check_scene.hpp"

#include "mir/runtime/check_world.hpp"
#include "mir/scene/shapes.hpp"
#include "support/catch.hpp"

#include <functional>
#include <limits>

namespace {

using mir::RenderResult;
using Warnings = std::vector<std::string>;

/// A result whose chains did well.
RenderResult healthy() {
    RenderResult r{{}, {}, {}, {}, {}, mir::Guides({1, 1}), {}, {}, {}};
    r.beauty = mir::Image<mir::Rgb>({1, 1}, {1, 1, 1});
    r.direct = mir::Image<mir::Rgb>({1, 1}, {0.6f, 0.6f, 0.6f});
    r.indirect = mir::Image<mir::Rgb>({1, 1}, {0.4f, 0.4f, 0.4f});
    r.statistics.emitted_power = 1.0f;
    r.statistics.vpls = 256;
    mir::ChainHealth h;
    h.chains = 128;
    h.recorded_states = 256;
    h.distinct_vpls = 200;
    h.mutations = 16384;
    h.large = {8192, 2000};
    h.small = {8192, 5000};
    h.effective_samples = 200.0;
    h.split_r_hat = 1.02;
    h.luminance = mir::PathLuminance{1.0, 0.01, 16384, 9000};
    h.large_step_luminance = mir::PathLuminance{1.01, 0.01, 16384, 9000};
    r.statistics.health = h;
    return r;
}

Warnings warnings_after(const std::function<void(mir::RenderStatistics&)>& change) {
    RenderResult r = healthy();
    change(r.statistics);
    Warnings warnings;
    add_result_warnings(r, warnings);
    return warnings;
}

/// A wall of a dark material, of the size that is given; a lamp's material that nothing uses.
mir::Scene dark_wall(float size = 1.0f) {
    mir::Scene s;
    const auto wall = s.add(mir::lambertian("wall", {0.5f, 0.5f, 0.5f}));
    s.add(mir::emitter("lamp", {}, {1, 1, 1}));
    s.place(mir::builtin::quad("wall", wall, {0, 0, 0}, {size, 0, 0}, {0, size, 0}));
    s.cameras.push_back(mir::Camera::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.8f));
    s.cameras[0].name = "front";
    return s;
}

/// What a renderer says before it begins.
std::string refusal(const mir::Scene& scene) {
    try {
        static_cast<void>(mir::check_scene(scene, {}));
        mir::check_world(scene, 0, mir::WorldGeometry(scene));
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::invalid_input);
        return e.what();
    }
    return "";
}

mir::Scene lit_wall(float size = 1.0f) {
    mir::Scene s = dark_wall(size);
    s.point_lights.push_back({"bulb", {0, 0, 1}, {1, 1, 1}});
    return s;
}

void check_starts(const std::string& text, const std::string& with) {
    CAPTURE(text);
    CHECK(text.starts_with(with));
}

}  // namespace

TEST_CASE("an emissive material is light where a triangle uses it that is placed") {
    mir::Scene s = dark_wall();
    CHECK_FALSE(mir::has_light(s));
    check_starts(refusal(s), "the scene has no light");
    mir::Mesh lamp = mir::builtin::quad("lamp", 1, {0, 0, 2}, {1, 0, 0}, {0, 1, 0});
    s.meshes.push_back(lamp);
    CHECK_FALSE(mir::has_light(s));
    lamp.triangles.clear();
    s.place(lamp);
    CHECK_FALSE(mir::has_light(s));
    s.instances.push_back({1});
    CHECK(mir::has_light(s));
    CHECK(refusal(s).empty());
    s = lit_wall();
    CHECK(refusal(s).empty());
}

TEST_CASE("a scene without a triangle to draw is refused") {
    mir::Scene s = lit_wall();
    s.meshes[0].triangles.clear();
    check_starts(refusal(s), "the scene has no triangles");
    s = lit_wall();
    s.instances[0].to_world = mir::Mat4(0.0f);
    s.instances[0].to_world[3][3] = 1.0f;
    check_starts(refusal(s), "the scene has nothing to draw (none of its 2 triangles has an area)");
}

TEST_CASE("what lies where no ray can start is refused by name") {
    CHECK(refusal(lit_wall(9e16f)).empty());
    check_starts(refusal(lit_wall(2e18f)), "a mesh lies 2e+18 m");
    mir::Scene s = lit_wall();
    s.point_lights[0].position.y = -2e18f;
    check_starts(refusal(s), "light 'bulb' lies 2e+18 m");
    s = lit_wall();
    s.cameras[0].position.x = std::numeric_limits<float>::quiet_NaN();
    check_starts(refusal(s), "camera 'front' lies");
    s = lit_wall();
    s.cameras[0].lens_radius = 5e18f;
    check_starts(refusal(s), "the lens of camera 'front' lies 5e+18 m");
}

TEST_CASE("chains that do well are not warned of") {
    CHECK(warnings_after([](mir::RenderStatistics&) {}).empty());
}

TEST_CASE("lobes and noise of direct light that a picture bears are not warned of") {
    CHECK(warnings_after([](mir::RenderStatistics& s) {
              s.non_lambertian_share = 0.12f;  // 5 % of the picture where VPLs bring 40 %
              s.direct_noise = 0.16;           // 10 % where direct light brings 60 %
          }).empty());
}

TEST_CASE("light paths that know their light to a tenth, or are merely few, are not warned of") {
    for (const mir::PathLuminance known :
         {mir::PathLuminance{1.0, 0.09, 300, 40}, mir::PathLuminance{1.0, 0.3, 20, 12}})
        CHECK(warnings_after([&known](mir::RenderStatistics& s) {
                  s.health.reset();
                  s.light_path_luminance = known;
              }).empty());
}

TEST_CASE("chains too short for a second estimate of the luminance are not warned of one") {
    CHECK(warnings_after([](mir::RenderStatistics& s) {
              s.health->mutations = 0;
              s.health->large = s.health->small = {};
              s.health->large_step_luminance = {};
          }).empty());
}

TEST_CASE("light that was traced back is not missed") {
    CHECK(warnings_after([](mir::RenderStatistics& s) {
              s.indirect_luminance = 0.8;
              s.removed_luminance = 0.2;
              s.residual_paths = 1;
          }).empty());
}

TEST_CASE("each bad value of a render is one worded warning") {
    using Statistics = mir::RenderStatistics;
    struct Case {
        const char* part;
        std::function<void(Statistics&)> change;
    };
    const Case cases[] = {
        {"none of 16384 paths", [](Statistics& s) { s.health->luminance.contributing = 0; }},
        {"known to 10 % only", [](Statistics& s) { s.health->luminance.standard_error = 0.1; }},
        {"known to 30 % only, and is more often too dark (300 light paths are worth 11",
         [](Statistics& s) {
             s.health.reset();
             s.light_path_luminance = mir::PathLuminance{1.0, 0.3, 300, 40};
         }},
        {"known to 8 % only, and is more often too dark",
         [](Statistics& s) {
             s.health.reset();
             s.light_path_luminance = mir::PathLuminance{1.0, 0.08, 80000, 208};
         }},
        {"hardly any light path reaches",
         [](Statistics& s) {
             s.health.reset();
             s.indirect_luminance = 1.0;
             s.light_path_luminance = mir::PathLuminance{0.0, 0.0, 300, 0};
         }},
        {"disagree by", [](Statistics& s) { s.health->large_step_luminance.mean = 1.2; }},
        {"cut short", [](Statistics& s) { s.health->capped = true; }},
        {"no mutation was accepted",
         [](Statistics& s) { s.health->large.accepted = s.health->small.accepted = 0; }},
        {"worth 50 independent", [](Statistics& s) { s.health->effective_samples = 50.0; }},
        {"chains disagree (split R-hat 1.80",
         [](Statistics& s) {
             s.health->split_r_hat = 1.8;
             s.health->effective_samples = 100.0;
         }},
        {"0.5 % of the VPLs light no luxel", [](Statistics& s) { s.dropped_share = 0.005; }},
        {"3 triangles without area", [](Statistics& s) { s.dropped_triangles = 3; }},
        {"4 triangles lie in one place", [](Statistics& s) { s.coinciding_triangles = 4; }},
        {"the bound removed 20.0 %",
         [](Statistics& s) {
             s.indirect_luminance = 0.8;
             s.removed_luminance = 0.2;
         }},
        {"glossy surfaces bring 8 % of", [](Statistics& s) { s.non_lambertian_share = 0.2f; }},
        {"by 20 % in a typical pixel; 2 times as many",
         [](Statistics& s) { s.direct_noise = 0.2; }},
        {"through lobes of that roughness", [](Statistics& s) { s.widened_share = 0.02f; }},
        {"no VPL was placed",
         [](Statistics& s) {
             s.health.reset();
             s.vpls = 0;
         }},
    };
    for (const Case& c : cases) {
        const Warnings warnings = warnings_after(c.change);
        CAPTURE(c.part, warnings);
        REQUIRE(warnings.size() == 1);
        CHECK(warnings[0].find(c.part) != std::string::npos);
    }
}
