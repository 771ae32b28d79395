// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/math.hpp"

#include <cmath>

namespace mir {

namespace detail {

/// What a number in the acceptance of a mutation was to be.
enum class ChainNumber { target, current_target, transition };

/// What to tell the user when it is not.
inline const char* sentence_for(ChainNumber number) {
    switch (number) {
        case ChainNumber::target:
            return "the target function of a Markov chain is negative or not finite (a "
                   "contribution or its density overflowed); please report the scene";
        case ChainNumber::current_target:
            return "a Markov chain stands on a state without contribution (no seed or accepted "
                   "proposal can be one); please report the scene";
        default:
            return "the density of a mutation is not positive and finite one way or negative or "
                   "not finite the other (a proposal must have been possible); please report the "
                   "scene";
    }
}

/// Returns `value`, or NaN on a device unless `ok`. Kernels cannot throw, and NaN is no
/// probability.
/// @throws Error(internal) on the host unless `ok`.
MIR_HD inline double checked(bool ok, double value, [[maybe_unused]] ChainNumber number,
                             [[maybe_unused]] Where at) {
    if (ok) return value;
#if defined(__CUDA_ARCH__)
    return nan("");
#else
    throw Error(ErrorCode::internal, sentence_for(number), at);
#endif
}

/// checked() for a number that must be finite and not negative.
MIR_HD inline double checked_weight(double value, ChainNumber number, Where at = Where::here()) {
    return checked(value >= 0.0 && is_finite(value), value, number, at);
}

/// checked() for a number that must be finite and positive.
MIR_HD inline double checked_positive(double value, ChainNumber number, Where at = Where::here()) {
    return checked(value > 0.0 && is_finite(value), value, number, at);
}

}  // namespace detail

// Below, errors are thrown on the host; on a device the result is NaN instead.

/// Probability min(1, f(y) / f(x)) of accepting y after x, symmetric proposals. The density of
/// proposing y is symmetric in x and y. `f_x`, `f_y`: target function, any common scale. 0 when
/// f(y) is 0.
/// @throws Error(internal) unless f(x) is positive, f(y) not negative, and both finite.
/// Source: Metropolis et al. 1953.
MIR_HD inline double acceptance(double f_x, double f_y) {
    const double x = detail::checked_positive(f_x, detail::ChainNumber::current_target);
    const double y = detail::checked_weight(f_y, detail::ChainNumber::target);
    return y >= x ? 1.0 : y / x;
}

/// Probability min(1, [f(y) / K(y|x)] / [f(x) / K(x|y)]) of accepting y after x. `K_xy` = K(y|x) is
/// the density with which y is proposed from x, `K_yx` = K(x|y) that of the way back, in the same
/// measure as f. For Veach's bidirectional mutation both hold the sum over all strategies that
/// could have inserted the vertices in question.
/// @throws Error(internal) unless f(x) and K(y|x) are positive, f(y) and K(x|y) not negative, and
/// all finite.
/// Source: Hastings 1970; Veach 1997, equation 11.5.
MIR_HD inline double acceptance(double f_x, double K_xy, double f_y, double K_yx) {
    using detail::ChainNumber;
    const double x = detail::checked_positive(f_x, ChainNumber::current_target);
    const double y = detail::checked_weight(f_y, ChainNumber::target);
    const double there = detail::checked_positive(K_xy, ChainNumber::transition);
    const double back = detail::checked_weight(K_yx, ChainNumber::transition);
    const bool is_impossible = y == 0.0 || back == 0.0;
    const double ratio = (y / x) * (back / there);
    if (is_impossible && is_finite(x + y + there + back)) return 0.0;
    if (ratio >= 1.0) return 1.0;
    return detail::checked(ratio < 1.0, ratio, ChainNumber::transition, Where::here());
}

}  // namespace mir
