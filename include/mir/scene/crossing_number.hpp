// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/mix_bits.hpp"

#include <cstdint>
#include <cstring>

namespace mir {

namespace detail {

/// A number for each point, the same for both zeros.
MIR_HD inline std::uint64_t number_of_point(Vec3 p) {
    const auto word = [](float x) {
        std::uint32_t bits = 0;
        memcpy(&bits, &x, sizeof bits);
        return x == 0.0f ? std::uint64_t{0} : std::uint64_t{bits};
    };
    constexpr std::uint64_t salt = 0x6D69722D676C6173u;
    return mix_bits(mix_bits((word(p.x) | word(p.y) << 32) + salt) + word(p.z));
}

}  // namespace detail

/// Number in [0, 1) of the crossing of a triangle by the segment from `a` to `b`, metres. Uniform
/// and independent for each segment and triangle, as good as random, and a function of nothing
/// else: the same when the ends change places, and on host and device. A multiple of 2^-23.
[[nodiscard]] MIR_HD inline float crossing_number(Vec3 a, Vec3 b, std::uint32_t triangle) {
    constexpr std::uint64_t golden = 0x9E3779B97F4A7C15u;
    const std::uint64_t segment = detail::number_of_point(a) + detail::number_of_point(b);
    const std::uint64_t bits = mix_bits(segment + golden * (std::uint64_t{triangle} + 1));
    return static_cast<float>(bits >> 41) * 0x1p-23f;
}

}  // namespace mir
