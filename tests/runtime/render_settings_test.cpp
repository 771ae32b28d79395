// SPDX-License-Identifier: MIT
#include "mir/runtime/check_settings.hpp"
#include "mir/runtime/settings_hash.hpp"
#include "support/catch.hpp"

TEST_CASE("counts of the path tracer are checked before anything is rendered") {
    mir::RenderSettings s;
    s.integrator = mir::Integrator::path;
    for (const std::uint32_t most : {1u, 65536u}) {
        s.path.directions = most;
        CHECK_NOTHROW(check(s));
    }
    for (const std::uint32_t wrong : {0u, 65537u}) {
        s.path.directions = wrong;
        CHECK_THROWS_AS(check(s), mir::Error);
    }
    s.path.directions = 1;
    for (const std::uint32_t wrong : {0u, (1u << 24) + 1}) {
        s.path.samples = wrong;
        CHECK_THROWS_AS(check(s), mir::Error);
    }
}

TEST_CASE("pairs of a pass are counted without overflow") {
    mir::RenderSettings s;
    s.image = {16384, 16384};
    s.luxels_per_pixel = 64;
    s.vpls = 4'000'000;
    s.sum = mir::LightSum::all;
    CHECK(mir::pairs(s) == 16384.0 * 16384.0 * 64.0 * 4e6);
}

TEST_CASE("GPUs are chosen once each, and all or by number") {
    mir::RenderSettings s;
    s.devices.numbers = {1, 0};
    CHECK_NOTHROW(check(s));
    s.devices.numbers = {1, 0, 1};
    CHECK_THROWS_AS(check(s), mir::Error);
    s.devices = {true, {0}};
    CHECK_THROWS_AS(check(s), mir::Error);
    s.devices.numbers.clear();
    CHECK_NOTHROW(check(s));
}

TEST_CASE("A picture does not depend on which GPUs make it, and so its fingerprint") {
    mir::RenderSettings s;
    const std::uint64_t one = mir::SettingsHash(s).value();
    s.devices.numbers = {0, 1};
    CHECK(mir::SettingsHash(s).value() == one);
    s.seed = 1;
    CHECK(mir::SettingsHash(s).value() != one);
}
