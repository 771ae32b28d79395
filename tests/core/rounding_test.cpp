// SPDX-License-Identifier: MIT
#include "mir/core/rounding.hpp"

#include "support/catch.hpp"
#include "support/instruction_sets.hpp"
#include "support/random_segments.hpp"

#include <bit>
#include <cmath>
#include <limits>

// What is rounded once against std::fma(), which the standard says is.
namespace {

using mir::FusedRounding;
using mir::Rgb;
using mir::SeparateRounding;
using mir::SimulatedFusedRounding;
using mir::Vec3;

constexpr int lanes = 16;

struct Operands {
    float a[lanes];
    float b[lanes];
    float c[lanes];
};

/// Of any mantissa, 2^-13 to 2^3 in size.
float some_float(mir::Random& random) {
    const int exponent = static_cast<int>(random.next() * 16.0f) - 13;
    const float size = std::ldexp(1.0f + random.next(), exponent);
    return random.next() < 0.5f ? size : -size;
}

Operands some_operands(mir::Random& random) {
    Operands o{};
    for (int k = 0; k < lanes; ++k) {
        o.a[k] = some_float(random);
        o.b[k] = some_float(random);
        o.c[k] = some_float(random);
    }
    return o;
}

/// Products a little smaller than half of the last place of what they are added to, or than a
/// power of two around it: a double rounds such a sum to the middle of two floats.
Operands hard_operands(mir::Random& random) {
    Operands o = some_operands(random);
    for (int k = 0; k < lanes; ++k) {
        const float off = std::floor(random.next() * 4.0f) * 0x1p-23f;
        const int exponent = std::ilogb(o.c[k]) - 25 + static_cast<int>(random.next() * 3.0f);
        o.a[k] = std::ldexp(o.a[k] < 0.0f ? -1.0f - off : 1.0f + off, exponent);
        o.b[k] = 1.0f - off;
    }
    return o;
}

template <class Rounding>
void mul_add_all(const Operands& o, float (&result)[lanes]) {
    for (int k = 0; k < lanes; ++k) result[k] = Rounding::mul_add(o.a[k], o.b[k], o.c[k]);
}

/// Lanes in which `result` is not std::fma().
int differing(const Operands& o, const float (&result)[lanes]) {
    int count = 0;
    for (int k = 0; k < lanes; ++k)
        count += std::bit_cast<std::uint32_t>(result[k]) !=
                         std::bit_cast<std::uint32_t>(std::fma(o.a[k], o.b[k], o.c[k]))
                     ? 1
                     : 0;
    return count;
}

/// Rounds the sum to a double before it becomes a float: wrong where that double is a tie.
struct RoundsTwice {
    static float mul_add(float a, float b, float c) {
        return static_cast<float>(static_cast<double>(a) * static_cast<double>(b) +
                                  static_cast<double>(c));
    }
};

template <class Rounding, class Make>
int differing_in_many(const Make& operands) {
    mir::Random random = mirtest::test_random(91);
    int wrong = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Operands o = operands(random);
        float result[lanes];
        mul_add_all<Rounding>(o, result);
        wrong += differing(o, result);
    }
    return wrong;
}

}  // namespace

TEST_CASE("Fused operations are rounded once with every instruction set") {
    mir::Random random = mirtest::test_random(92);
    for (mir::InstructionSet set : mirtest::instruction_sets())
        for (int i = 0; i < 2000; ++i) {
            const Operands o = i % 2 == 0 ? some_operands(random) : hard_operands(random);
            float fused[lanes];
            float fastest[lanes];
            mir::run_with(set, [&](auto constant) {
                mul_add_all<FusedRounding>(o, fused);
                mul_add_all<mir::FusedRoundingFor<constant()>>(o, fastest);
            });
            REQUIRE(differing(o, fused) == 0);
            REQUIRE(differing(o, fastest) == 0);
        }
}

TEST_CASE("Fused operations are simulated in every bit") {
    CHECK(differing_in_many<SimulatedFusedRounding>(some_operands) == 0);
    CHECK(differing_in_many<SimulatedFusedRounding>(hard_operands) == 0);
    // The operands are hard enough to tell.
    CHECK(differing_in_many<RoundsTwice>(hard_operands) > 1000);
    CHECK(differing_in_many<SeparateRounding>(some_operands) > 1000);
}

TEST_CASE("Simulated operations pass on what is no number, no end, and no sign") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(std::isnan(SimulatedFusedRounding::mul_add(nan, 1.0f, 1.0f)));
    CHECK(std::isnan(SimulatedFusedRounding::mul_add(infinity, 0.0f, 1.0f)));
    CHECK(SimulatedFusedRounding::mul_add(infinity, 2.0f, 1.0f) == infinity);
    CHECK(SimulatedFusedRounding::mul_add(0x1p100f, 0x1p100f, 1.0f) == infinity);
    CHECK(SimulatedFusedRounding::mul_add(1.0f, 1.0f, -infinity) == -infinity);
    CHECK(std::signbit(SimulatedFusedRounding::mul_add(-0.0f, 1.0f, -0.0f)));
    CHECK_FALSE(std::signbit(SimulatedFusedRounding::mul_add(-0.0f, 1.0f, 0.0f)));
    const float least = std::numeric_limits<float>::denorm_min();
    CHECK(SimulatedFusedRounding::mul_add(least, 0.5f, least) == std::fma(least, 0.5f, least));
    CHECK(SimulatedFusedRounding::mul_add(least, 0.51f, 0.0f) == least);
}

TEMPLATE_TEST_CASE("Sums of products of vectors and colours", "", SeparateRounding, FusedRounding,
                   SimulatedFusedRounding) {
    CHECK(mir::dot<TestType>(Vec3(1, 2, 3), Vec3(4, -5, 6)) == 12.0f);
    CHECK(mir::mul_add<TestType>(2.0f, Vec3(1, 2, 3), Vec3(4, 5, 6)) == Vec3(6, 9, 12));
    CHECK(mir::mul_add<TestType>(2.0f, Rgb{1, 2, 3}, Rgb{4, 5, 6}) == Rgb{6, 9, 12});
}

TEST_CASE("Separate rounding is the dot product as glm has it") {
    mir::Random random = mirtest::test_random(93);
    for (int i = 0; i < 1000; ++i) {
        const auto vector = [&] {
            return Vec3(some_float(random), some_float(random), some_float(random));
        };
        const Vec3 v = vector();
        const Vec3 w = vector();
        REQUIRE(mir::dot<SeparateRounding>(v, w) == glm::dot(v, w));
    }
}
