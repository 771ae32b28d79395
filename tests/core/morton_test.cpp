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

TEST_CASE("The fine code has 21 bits on each axis") {
    CHECK(mir::fine_morton_code({0.5f, 0.0f, 0.0f}) == std::uint64_t{1} << 60);
    CHECK(mir::fine_morton_code({0.0f, 0.0f, 0x1p-21f}) == 0b100);
    CHECK(mir::fine_morton_code({1.0f, 2.0f, 1e9f}) == (std::uint64_t{1} << 63) - 1);
}
