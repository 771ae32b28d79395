// SPDX-License-Identifier: MIT
#include "mir/core/morton.hpp"

#include "support/catch.hpp"

using mir::morton_code;

TEST_CASE("Morton's curve interleaves the bits of x, y and z") {
    CHECK(morton_code({0.0f, 0.0f, 0.0f}) == 0);
    CHECK(morton_code({0.5f, 0.0f, 0.0f}) == 1u << 27);
    CHECK(morton_code({0.0f, 0.5f, 0.0f}) == 1u << 28);
    CHECK(morton_code({0.0f, 0.0f, 0.5f}) == 1u << 29);
    CHECK(morton_code({1.0f / 1024, 2.0f / 1024, 0.0f}) == 0b10001);
}

TEST_CASE("points outside the unit cube get the code of its nearest cell") {
    CHECK(morton_code({1.0f, 2.0f, 1e9f}) == (1u << 30) - 1);
    CHECK(morton_code({-1.0f, 0.0f, 0.0f}) == 0);
}
