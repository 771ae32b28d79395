// SPDX-License-Identifier: MIT
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

using namespace mirtest;
using nlohmann::json;

namespace {

/// The JSON of a small picture by about a thousand VPLs.
json rendered(const std::string& scene, const char* sampler) {
    const TemporaryFolder folder("light_paths");
    const Outcome outcome = run_mir({"render", scene, "-o", folder / "a.exr", "--no-png", "--width",
                                     "24", "--height", "18", "--luxels", "1", "--backend", "cpu",
                                     "--quiet", "--json", "--vpls", "1024", "--sampler", sampler});
    REQUIRE(outcome.exit_code == 0);
    return json::parse(outcome.out);
}

bool warns(const json& told) {
    for (const json& warning : told.at("warnings"))
        if (has(warning.get<std::string>(), "that bring the same); --sampler mir")) return true;
    return false;
}

double relative_error(const json& told) {
    const json& p = told.at("light_path_luminance");
    return p.at("standard_error").get<double>() / p.at("mean").get<double>();
}

}  // namespace

TEST_CASE("light paths that rarely find what lights the picture are warned of") {
    for (const char* sampler : {"ir", "keller"}) {
        INFO(sampler);
        const json dark = rendered("builtin:door-ajar", sampler);
        CHECK(relative_error(dark) > 0.1);
        CHECK(warns(dark));
        for (const char* scene : {"builtin:cornell-box", "builtin:sphere"}) {
            INFO(scene);
            const json well = rendered(scene, sampler);
            CHECK(relative_error(well) < 0.1);
            CHECK_FALSE(warns(well));
        }
    }
    const json chains = rendered("builtin:door-ajar", "mir");
    CHECK_FALSE(chains.contains("light_path_luminance"));
    CHECK_FALSE(warns(chains));
}
