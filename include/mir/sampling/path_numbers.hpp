// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/sampling/light_path_options.hpp"

namespace mir {

/// Radical inverse of `i` in `base`: its digits mirrored at the point, in [0, 1).
MIR_HD inline float radical_inverse(std::uint32_t base, std::uint64_t i) {
    const double inverse = 1.0 / base;
    double scale = inverse;
    double value = 0.0;
    for (; i != 0; i /= base, scale *= inverse) value += static_cast<double>(i % base) * scale;
    return smaller(static_cast<float>(value), 0x1.fffffep-1f);
}

/// The uniform numbers of one path, dimension after dimension. Each number of the Halton form is
/// uniform over seeds (random shift modulo one: Cranley and Patterson 1976), so estimates stay
/// unbiased.
class PathNumbers {
 public:
    /// Numbers of path `path` of a stream; a pure function of the arguments.
    MIR_HD PathNumbers(Sequence sequence, std::uint64_t seed, Stream stream, std::uint64_t path)
        : sequence_(sequence),
          path_(path),
          random_(seed, stream, path),
          shift_(seed, stream, ~std::uint64_t{0}) {}

    /// Number of the next dimension, in [0, 1).
    MIR_HD float next() {
        const std::uint32_t d = dimension_++;
        if (sequence_ == Sequence::random || d >= halton_dimensions) return random_.at(d);
        const float x = radical_inverse(prime(d), path_ + 1) + shift_.at(d);
        return x < 1.0f ? x : x - 1.0f;
    }
    /// Numbers of the next two dimensions, x first.
    MIR_HD Vec2 next_2d() {
        const float x = next();
        return {x, next()};
    }

 private:
    // Beyond some twenty dimensions neighbouring large primes correlate visibly.
    static constexpr std::uint32_t halton_dimensions = 20;
    MIR_HD static constexpr std::uint32_t prime(std::uint32_t d) {
        constexpr std::uint32_t primes[halton_dimensions] = {
            2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71};
        return primes[d];
    }

    Sequence sequence_;
    std::uint64_t path_;
    Random random_;
    Random shift_;
    std::uint32_t dimension_ = 0;
};

}  // namespace mir
