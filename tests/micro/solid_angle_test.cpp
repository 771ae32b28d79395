// SPDX-License-Identifier: MIT
#include "mir/micro/solid_angle.hpp"

#include "support/catch.hpp"

#include <cmath>

namespace {

constexpr long double pi = 3.14159265358979323846264338327950288L;

long double exact_cap(float s) { return 2 * pi * (1 - std::sqrt(1 - static_cast<long double>(s))); }

}  // namespace

TEST_CASE("The solid angle of a sphere keeps its error bound at any distance") {
    // Below 2^-20 even extended precision needs the series 1 - sqrt(1 - s) = s/2 + s^2/8 + ...
    double worst = 0.0;
    for (int k = 0; k < 4000; ++k) {
        const float s = std::exp2(-0.01f * static_cast<float>(k));
        const long double l = s;
        const long double truth =
            s > 0x1p-20f ? exact_cap(s) : 2 * pi * (l / 2 + l * l / 8 + l * l * l / 16);
        worst = std::max(worst, std::fabs(double(mir::cap_solid_angle(s) / truth - 1)));
    }
    CHECK(worst < 4 * 0x1p-24);
    CHECK(mir::cap_solid_angle(0.0f) == 0.0f);
    CHECK(mir::cap_solid_angle(1.0f) == 2.0f * mir::pi);
}

TEST_CASE("Squared sines and solid angles are each other's inverse") {
    double worst = 0.0;
    for (int k = 0; k < 3000; ++k) {
        const float s = std::exp2(-0.01f * static_cast<float>(k));
        const long double share = static_cast<long double>(mir::cap_solid_angle(s)) / (2 * pi);
        const long double truth = share * (2 - share);
        worst = std::max(
            worst, std::fabs(double(mir::cap_sine_squared(mir::cap_solid_angle(s)) / truth - 1)));
    }
    CHECK(worst < 4 * 0x1p-24);
    CHECK(mir::cap_sine_squared(0.0f) == 0.0f);
    CHECK(mir::cap_sine_squared(2.0f * mir::pi) == 1.0f);
    CHECK(mir::cap_sine_squared(12.0f) == 1.0f);
}
