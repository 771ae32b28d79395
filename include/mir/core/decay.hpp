// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/strict_float.hpp"

#include <cstdint>
#include <cstring>

namespace mir {

/// e^-x for x >= 0, to one unit of rounding, with the same bits on every machine. 0 beyond 87 and
/// for what is no number. A function of libraries may differ in the last bit.
[[nodiscard]] MIR_HD inline float decay(float x) {
    if (!(x < 87.0f)) return 0.0f;
    // e^-x = 2^-halvings e^-rest, 0 <= rest < ln 2, and the second factor is a power series.
    const double turns = strict::mul(static_cast<double>(x), 1.4426950408889634);
    const auto halvings = static_cast<std::uint32_t>(turns);
    const double rest =
        strict::mul(strict::sub(turns, static_cast<double>(halvings)), 0.6931471805599453);
    double sum = 1.0;
    for (int n = 12; n > 0; --n)
        sum = strict::sub(1.0, strict::mul(sum, strict::mul(rest, 1.0 / n)));
    const std::uint64_t bits = std::uint64_t{1023u - halvings} << 52;
    double scale = 0.0;
    memcpy(&scale, &bits, sizeof scale);
    return static_cast<float>(strict::mul(sum, scale));
}

}  // namespace mir
