// SPDX-License-Identifier: MIT
#include "mir/core/limits.hpp"

#include "support/catch.hpp"

#include <string>

namespace {

constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();

static_assert(mir::saturating_mul(0, most) == 0 && mir::saturating_mul(most, 0) == 0);
static_assert(mir::saturating_mul(3, 7) == 21);
static_assert(mir::saturating_mul(1, most) == most && mir::saturating_mul(most, 1) == most);
static_assert(mir::saturating_mul(2, most / 2) == most - 1);
static_assert(mir::saturating_mul(2, most / 2 + 1) == most);
static_assert(mir::saturating_mul(1ull << 32, 1ull << 32) == most);
static_assert(mir::saturating_mul((1ull << 32) - 1, (1ull << 32) + 1) == most);

}  // namespace

TEST_CASE("check_limit lets through what is allowed, the bound included") {
    CHECK_NOTHROW(mir::check_limit(0, 0, "pixels"));
    CHECK_NOTHROW(mir::check_limit(100, 100, "pixels"));
}

TEST_CASE("check_limit names what is too much, both numbers and the field to raise") {
    try {
        mir::check_limit(101, 100, "pixels");
        FAIL("101 passed a limit of 100");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::limit_exceeded);
        const std::string message = e.what();
        for (const char* part : {"101 pixels", "Limits::pixels", "100", "raise the limit"})
            CHECK(message.find(part) != std::string::npos);
        CHECK(std::string(e.where().file).find("limits_test.cpp") != std::string::npos);
    }
}
