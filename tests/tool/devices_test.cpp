// SPDX-License-Identifier: MIT
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

using namespace mirtest;

TEST_CASE("the processor is listed with its threads") {
    const Outcome devices = run_mir({"devices"});
    CHECK(devices.exit_code == 0);
    CHECK(devices.err.empty());
    CHECK(devices.out.rfind("cpu: ", 0) == 0);
    CHECK(has(devices.out, "Embree"));
}

TEST_CASE("devices are listed as JSON too") {
    const auto json = nlohmann::json::parse(run_mir({"devices", "--json"}).out);
    REQUIRE(json.at("devices").size() >= 1);
    const auto& processor = json.at("devices").at(0);
    CHECK(processor.at("name") == "cpu");
    CHECK(processor.at("threads").get<int>() >= 1);
    CHECK(has(processor.at("description").get<std::string>(), "Embree"));
}

TEST_CASE("a backend that cannot be used is named with the reason") {
    const Outcome devices = run_mir({"devices"});
    const auto json = nlohmann::json::parse(run_mir({"devices", "--json"}).out);
    if (json.at("devices").size() > 1) {
        CHECK(json.at("unavailable").empty());
        return;
    }
    REQUIRE(json.at("unavailable").size() == 1);
    const auto why = json.at("unavailable").at(0).get<std::string>();
    CHECK(why.starts_with("cuda: "));
    CHECK(has(devices.out, why));
    // What cannot be used is refused with its own exit code, and nothing is written.
    const Outcome render = run_mir({"render", "builtin:sphere", "--backend", "cuda"});
    CHECK(render.exit_code == 4);
}

TEST_CASE("devices takes no scene") { check_failure(run_mir({"devices", "builtin:sphere"}), 2); }
