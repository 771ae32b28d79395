// SPDX-License-Identifier: MIT
#include "mir/core/random.hpp"

#include "support/catch.hpp"

#include <set>
#include <vector>

using mir::Bits128;
using mir::Random;
using mir::Stream;

// Source of the known answers: Random123, file kat_vectors, philox4x32 with 10 rounds.
static_assert(mir::philox4x32({{0, 0, 0, 0}}, 0) ==
              Bits128{{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}});
static_assert(mir::philox4x32({{~0u, ~0u, ~0u, ~0u}}, ~0ull) ==
              Bits128{{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}});
static_assert(mir::philox4x32({{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}},
                              0x299f31d0a4093822ull) ==
              Bits128{{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}});

TEST_CASE("philox4x32 gives the known answers of Random123 at run time too") {
    volatile std::uint32_t zero = 0;
    const Bits128 found = mir::philox4x32({{zero, zero, zero, zero}}, zero);
    CHECK(found == Bits128{{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}});
}

TEST_CASE("to_unit_float stays below one and not below zero") {
    CHECK(mir::to_unit_float(0) == 0.0f);
    CHECK(mir::to_unit_float(0x80000000u) == 0.5f);
    CHECK(mir::to_unit_float(0xFFFFFFFFu) == 1.0f - 0x1p-24f);
    CHECK(mir::to_unit_float(0xFFFFFFFFu) < 1.0f);
}

TEST_CASE("at() is the sequence of next() and leaves it alone") {
    const Random fixed(42, Stream::test, 7);
    Random running(42, Stream::test, 7);
    for (std::uint32_t d = 0; d < 1000; ++d) {
        REQUIRE(running.next() == fixed.at(d));
        static_cast<void>(running.at(3 * d));
    }
}

TEST_CASE("nearby numbers are those of Random in any order") {
    const Random random(42, Stream::test, 7);
    mir::NearbyNumbers nearby(random);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const std::uint32_t d = 7 * i % 61 / (1 + i % 3);
        REQUIRE(nearby.at(d) == random.at(d));
    }
}

TEST_CASE("next_2d takes two numbers, x first") {
    Random a(1, Stream::test, 2);
    const Random b(1, Stream::test, 2);
    const mir::Vec2 p = a.next_2d();
    CHECK(p.x == b.at(0));
    CHECK(p.y == b.at(1));
    CHECK(a.next() == b.at(2));
}

TEST_CASE("Seeds, streams and indices share no block of numbers") {
    const auto block = [](std::uint64_t seed, Stream stream, std::uint64_t index) {
        const Random r(seed, stream, index);
        return std::vector<float>{r.at(0), r.at(1), r.at(2), r.at(3)};
    };
    std::set<std::vector<float>> seen;
    std::size_t asked = 0;
    for (std::uint64_t seed : {0ull, 1ull, 1ull << 32, ~0ull})
        for (auto stream : {Stream::luxel, Stream::lens, Stream::direct_light, Stream::light_path,
                            Stream::pilot, Stream::test})
            for (std::uint64_t index : {0ull, 1ull, 1ull << 32, (1ull << 32) + 1, ~0ull}) {
                seen.insert(block(seed, stream, index));
                ++asked;
            }
    CHECK(seen.size() == asked);
}

// Hypothesis: the numbers are uniform over 64 cells, and so are pairs over 8 x 8 cells, both along
// one sequence and across neighbouring indices. Pearson's chi-squared with 63 degrees of freedom at
// level 1e-6: 129.3 (quantile 4.75 of Wilson and Hilferty's approximation). Seed 2009.
TEST_CASE("Numbers are uniform along sequences and across indices", "[statistical]") {
    constexpr int samples = 64 * 1000;
    std::vector<double> single(64), along(64), across(64);
    for (int i = 0; i < samples; ++i) {
        Random a(2009, Stream::test, i);
        const Random b(2009, Stream::test, i + 1);
        const mir::Vec2 p = a.next_2d();
        single[static_cast<std::size_t>(p.x * 64.0f)] += 1.0;
        along[static_cast<std::size_t>(p.x * 8.0f) * 8 + static_cast<std::size_t>(p.y * 8.0f)] += 1;
        across[static_cast<std::size_t>(p.x * 8.0f) * 8 +
               static_cast<std::size_t>(b.at(0) * 8.0f)] += 1;
    }
    const auto chi_squared = [](const std::vector<double>& counts) {
        double sum = 0.0;
        for (double c : counts) sum += (c - 1000.0) * (c - 1000.0) / 1000.0;
        return sum;
    };
    CHECK(chi_squared(single) < 129.3);
    CHECK(chi_squared(along) < 129.3);
    CHECK(chi_squared(across) < 129.3);
}
