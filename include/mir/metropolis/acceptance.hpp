// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <cmath>

namespace mir {

namespace detail {

/// Returns `value`.
/// @throws Error(internal) with `sentence` unless it is finite and not negative.
inline double checked_weight(double value, const char* sentence, Where at = Where::here()) {
    if (!(value >= 0.0 && std::isfinite(value))) throw Error(ErrorCode::internal, sentence, at);
    return value;
}

/// @throws Error(internal) unless `value` is finite and positive.
inline double checked_positive(double value, const char* sentence, Where at = Where::here()) {
    return checked_weight(value > 0.0 ? value : -1.0, sentence, at);
}

inline constexpr const char* bad_target =
    "the target function of a Markov chain is negative or not finite (a contribution or its "
    "density overflowed); please report the scene";
inline constexpr const char* dark_state =
    "a Markov chain stands on a state without contribution (no seed or accepted proposal can be "
    "one); please report the scene";
inline constexpr const char* bad_transition =
    "the density of a mutation is not positive and finite one way or negative or not finite the "
    "other (a proposal must have been possible); please report the scene";

}  // namespace detail

/// Probability min(1, f(y) / f(x)) of accepting y as the successor of x when y was proposed with
/// a density that is symmetric in x and y.
/// `f_x`, `f_y`: target function, any common scale. 0 when f(y) is 0.
/// @throws Error(internal) unless f(x) is positive, f(y) not negative, and both finite.
/// Source: Metropolis et al. 1953.
inline double acceptance(double f_x, double f_y) {
    detail::checked_positive(f_x, detail::dark_state);
    detail::checked_weight(f_y, detail::bad_target);
    return f_y < f_x ? f_y / f_x : 1.0;
}

/// Probability min(1, [f(y) / K(y|x)] / [f(x) / K(x|y)]) of accepting y as the successor of x.
/// `K_xy` = K(y|x) is the density with which y is proposed from x, `K_yx` = K(x|y) that of the way
/// back, in the same measure as f. For Veach's bidirectional mutation both hold the sum over all
/// strategies that could have inserted the vertices in question.
/// @throws Error(internal) unless f(x) and K(y|x) are positive, f(y) and K(x|y) not negative, and
/// all finite.
/// Source: Hastings 1970; Veach 1997, equation 11.5.
inline double acceptance(double f_x, double K_xy, double f_y, double K_yx) {
    detail::checked_positive(f_x, detail::dark_state);
    detail::checked_weight(f_y, detail::bad_target);
    detail::checked_positive(K_xy, detail::bad_transition);
    detail::checked_weight(K_yx, detail::bad_transition);
    if (f_y == 0.0 || K_yx == 0.0) return 0.0;
    const double ratio = (f_y / f_x) * (K_yx / K_xy);
    if (std::isnan(ratio)) throw Error(ErrorCode::internal, detail::bad_transition);
    return ratio < 1.0 ? ratio : 1.0;
}

}  // namespace mir
