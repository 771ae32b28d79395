// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/hd.hpp"

#include <cmath>
#include <cstdint>

namespace mir {

namespace detail {

/// 2^x for |x| < 1000 to a relative error of 1e-8. IEEE 754 rounds its operations alike everywhere.
/// std::exp2 differs between machines, and one differing bit sends a chain elsewhere.
MIR_HD inline double portable_exp2(double x) {
    constexpr double ln2 = 0.69314718055994531;
    constexpr double sqrt2 = 1.41421356237309505;
    const double whole = floor(x);
    const double y = (x - whole - 0.5) * ln2;  // |y| <= ln(2) / 2
    const double inverse_factorials[] = {1.0 / 720, 1.0 / 120, 1.0 / 24, 1.0 / 6, 0.5, 1.0, 1.0};
    double e = 1.0 / 5040;  // Taylor series of exp(y), Horner's scheme
    for (const double c : inverse_factorials) e = e * y + c;
    return ldexp(e * sqrt2, static_cast<int>(whole));
}

}  // namespace detail

/// Small move of one coordinate of primary sample space, wrapped around [0, 1). u' = u +- s2
/// exp(-xi ln(s2 / s1)). Both signs are equally likely and xi is uniform, so the density of the
/// length is proportional to 1 / length between s1 and s2.
///
/// Coordinates are multiples of 2^-24, as all numbers of `Random` are, and lengths are rounded to
/// them. So wrapping is exact, 1 is never returned, and T(u -> v) == T(v -> u) in every bit.
///
/// Immutable; const use from any thread.
/// Source: Kelemen et al., "A simple and robust mutation strategy for the Metropolis light
/// transport algorithm", Eurographics 2002.
class SmallStep {
 public:
    /// s1 = 1/1024 and s2 = 1/64, the sizes of the paper.
    MIR_HD SmallStep() : longest_(0x1p-6 * cells), octaves_(4.0) {}

    /// Lengths from `smallest` (s1) to `largest` (s2), 2^-24 <= s1 <= s2 <= 1/2.
    /// @throws Error(invalid_argument) outside this range.
    SmallStep(float smallest, float largest)
        : longest_(static_cast<double>(largest) * cells),
          octaves_(std::log2(static_cast<double>(largest) / static_cast<double>(smallest))) {
        expects(smallest >= 1.0f / cells && smallest <= largest && largest <= 0.5f,
                "the lengths of a small step do not satisfy 2^-24 <= smallest <= largest <= 1/2 "
                "(coordinates live on a circle of length 1); the usual lengths are 1/1024 and "
                "1/64");
    }

    /// Moves `u` by the length and sign that `number` stands for. Both are multiples of 2^-24 in
    /// [0, 1); numbers that differ by 1/2 move equally far, in opposite directions.
    [[nodiscard]] MIR_HD float perturb(float u, float number) const {
        const bool up = number < 0.5f;
        const std::uint32_t length = length_in_cells(2.0f * (up ? number : number - 0.5f));
        const auto from = static_cast<std::uint32_t>(u * cells);
        const std::uint32_t to = up ? from + length : from - length;
        return static_cast<float>(to % cells) / cells;
    }

 private:
    static constexpr std::uint32_t cells = 1u << 24;

    [[nodiscard]] MIR_HD std::uint32_t length_in_cells(float xi) const {
        const double cells_moved =
            longest_ * detail::portable_exp2(-octaves_ * static_cast<double>(xi));
        const auto below = static_cast<std::uint32_t>(cells_moved);
        return cells_moved - static_cast<double>(below) < 0.5 ? below : below + 1;
    }

    double longest_;  // in cells
    double octaves_;  // log2(s2 / s1)
};

}  // namespace mir
