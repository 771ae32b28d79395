// SPDX-License-Identifier: MIT
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>

using namespace mirtest;

namespace {

/// What a picture of 8 x 8 pixels says of itself.
nlohmann::json facts_of(const char* scene, const Words& more) {
    const TemporaryFolder folder("quality");
    const Words words{"render", scene, "--width", "8",  "--height",
                      "8",      "-q",  "--json",  "-o", (folder / "a.exr").string()};
    return nlohmann::json::parse(run_mir(words + more).out);
}

}  // namespace

TEST_CASE("a quality chooses what was left open") {
    using Found = std::array<std::uint64_t, 3>;
    const auto found = [](const Words& more) {
        const auto r = facts_of("builtin:cornell-box", more);
        return Found{r.at("luxels").get<std::uint64_t>() / 64, r.at("picks").get<std::uint64_t>(),
                     r.at("vpls").get<std::uint64_t>() >> 14};
    };
    const std::uint64_t thousand = 0;  // VPLs of a classic render, in steps of 16384
    CHECK(found({}) == Found{4, 256, 16});
    CHECK(found({"--quality", "good"}) == found({}));
    CHECK(found({"--quality", "draft"}) == Found{1, 64, 4});
    CHECK(found({"--quality", "final"}) == Found{16, 512, 64});
    CHECK(found({"--quality", "draft", "--luxels", "2", "--picks", "9"}) == Found{2, 9, 4});
    CHECK(found({"--vpls", "32768"}) == Found{4, 256, 2});
    // VPLs so few, or of such a kind, that each luxel gathers all.
    CHECK(found({"--vpls", "1000"}) == Found{4, 0, thousand});
    CHECK(found({"--sampler", "mir"}) == Found{4, 0, thousand});
    CHECK(found({"--chains", "64"}) == Found{4, 0, thousand});
    CHECK(found({"--sum", "all"}) == Found{4, 0, thousand});
    CHECK(found({"--direct", "vpl"}) == Found{4, 0, thousand});
    CHECK(found({"--vsl"}) == Found{4, 0, thousand});
    CHECK(found({"--aov", "removed"}) == Found{4, 0, thousand});
}

TEST_CASE("a quality has the light traced back that its bound takes, where there is one") {
    const auto found = [](const Words& more) {
        const auto r = facts_of("builtin:cornell-box", Words{"--quality", "draft"} + more);
        return r.at("residual_paths").get<std::uint64_t>() / 64;
    };
    CHECK(found({}) == 1);
    CHECK(found({"--luxels", "2"}) == 2);
    CHECK(found({"--compensate", "3"}) == 3);
    CHECK(found({"--compensate", "0"}) == 0);
    CHECK(found({"--bound", "none"}) == 0);
    CHECK(found({"--vsl"}) == 0);
    CHECK(found({"--vpls", "100"}) == 0);
}

// The bound of picks alone, and the fourth of it where paths bring what it takes.
TEST_CASE("cuts have a lower bound where what it takes is traced back") {
    const auto bound = [](const Words& more) {
        const auto r = facts_of("builtin:cornell-box", Words{"--quality", "draft"} + more);
        return r.at("bound").get<double>();
    };
    CHECK(bound({"--compensate", "0"}) == Approx(4.0 * bound({})));
    CHECK(bound({"--vpls", "512", "--compensate", "0"}) == bound({"--vpls", "512"}));
    CHECK(bound({"--bound", "7"}) == 7.0);
}

TEST_CASE("a quality chooses the light paths of caustics, where none are asked for") {
    const auto found = [](const Words& more) {
        return facts_of("builtin:caustics", more).at("caustic_paths");
    };
    CHECK(found({"--quality", "draft"}) == 64);
    CHECK(found({}) == 4 * 64);
    CHECK(found({"--quality", "final"}) == 8 * 64);
    CHECK(found({"--quality", "draft", "--caustics", "3"}) == 3 * 64);
    CHECK(found({"--quality", "final", "--caustics", "auto"}) == 8 * 64);
    CHECK(found({"--caustics", "none"}) == 0);
    CHECK(found({"--caustics", "0"}) == 0);
}
