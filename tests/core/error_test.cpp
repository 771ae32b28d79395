// SPDX-License-Identifier: MIT
#include "mir/core/error.hpp"

#include "support/catch.hpp"

#include <string>

TEST_CASE("An error carries its code, its sentence and the caller's place") {
    const std::uint32_t line = __LINE__ + 1;
    const mir::Error error(mir::ErrorCode::io, "the disc is full; free some space");
    CHECK(error.code() == mir::ErrorCode::io);
    CHECK(std::string(error.what()) == "the disc is full; free some space");
    CHECK(error.where().line == line);
    CHECK(std::string(error.where().file).find("error_test.cpp") != std::string::npos);
}

TEST_CASE("An error is a std::runtime_error") {
    CHECK_THROWS_AS(throw mir::Error(mir::ErrorCode::internal, "x"), std::runtime_error);
}

TEST_CASE("expects() throws only when the precondition fails, and names its caller") {
    CHECK_NOTHROW(mir::expects(true, "never said"));
    std::uint32_t line = 0;
    try {
        line = __LINE__ + 1;
        mir::expects(false, "a number is missing; give one");
        FAIL("expects(false) returned");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::invalid_argument);
        CHECK(std::string(e.what()) == "a number is missing; give one");
        CHECK(e.where().line == line);
    }
}
