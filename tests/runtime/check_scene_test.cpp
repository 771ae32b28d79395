// SPDX-License-Identifier: MIT
#include "mir/runtime/check_scene.hpp"

#include "support/catch.hpp"

#include <functional>

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

}  // namespace

TEST_CASE("chains that do well are not warned of") {
    CHECK(warnings_after([](mir::RenderStatistics&) {}).empty());
}

TEST_CASE("lobes and noise of direct light that a picture bears are not warned of") {
    CHECK(warnings_after([](mir::RenderStatistics& s) {
              s.non_lambertian_share = 0.12f;  // 5 % of the picture where VPLs bring 40 %
              s.direct_noise = 0.16;           // 10 % where direct light brings 60 %
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
