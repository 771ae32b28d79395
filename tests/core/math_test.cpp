// SPDX-License-Identifier: MIT
#include "mir/core/math.hpp"

#include "mir/core/instruction_set.hpp"
#include "support/catch.hpp"

#include <limits>

namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

static_assert(mir::larger(1, 2) == 2 && mir::larger(2, 1) == 2);
static_assert(mir::smaller(1, 2) == 1 && mir::smaller(2, 1) == 1);
static_assert(mir::larger(nan_value, 3) == 3 && mir::smaller(nan_value, 3) == 3);

}  // namespace

TEST_CASE("max_abs and length_squared measure vectors") {
    CHECK(mir::max_abs({1, -3, 2}) == 3.0f);
    CHECK(mir::max_abs({-4, 0, 2}) == 4.0f);
    CHECK(mir::max_abs({0, 0, -5}) == 5.0f);
    CHECK(mir::length_squared({1, 2, 3}) == 14.0f);
}

TEST_CASE("One component that is not finite makes a vector not finite") {
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK(mir::is_finite(mir::Vec3(1, 2, 3)));
    CHECK_FALSE(mir::is_finite(mir::Vec3(1, nan_value, 3)));
    CHECK_FALSE(mir::is_finite(mir::Vec3(infinity, 2, 3)));
    CHECK_FALSE(mir::is_finite(mir::Vec3(1, 2, -infinity)));
}

TEST_CASE("run_with calls its body once for every instruction set of this processor") {
    using mir::InstructionSet;
    for (auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
        if (set > mir::best_instruction_set()) continue;
        int calls = 0;
        mir::run_with(set, [&] { ++calls; });
        CHECK(calls == 1);
    }
}
