// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace mirtest {

namespace detail {

/// 1 / x that a continued fraction may take of a vanishing denominator (modified Lentz).
inline double safe_inverse(double x) { return 1.0 / (std::fabs(x) < 1e-300 ? 1e-300 : x); }

/// Lower incomplete gamma function over its complete one, by its series; for x < a + 1.
inline double gamma_p_series(double a, double x) {
    double term = 1.0 / a;
    double sum = term;
    for (double n = a + 1.0; term > sum * 1e-16; n += 1.0) sum += term *= x / n;
    return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// Its complement by a continued fraction; for x >= a + 1.
inline double gamma_q_fraction(double a, double x) {
    double b = x + 1.0 - a;
    double c = 1e300;
    double d = safe_inverse(b);
    double h = d;
    for (int i = 1; i < 10'000; ++i) {
        const double an = -i * (i - a);
        b += 2.0;
        d = safe_inverse(an * d + b);
        c = b + an / c;
        h *= d * c;
        if (std::fabs(d * c - 1.0) < 1e-15) break;
    }
    return h * std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// Continued fraction of the incomplete beta function.
inline double beta_fraction(double a, double b, double x) {
    double c = 1.0;
    double d = safe_inverse(1.0 - (a + b) * x / (a + 1.0));
    double h = d;
    for (int m = 1; m < 10'000; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m));
        d = safe_inverse(1.0 + even * d);
        c = 1.0 + even / c;
        h *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0));
        d = safe_inverse(1.0 + odd * d);
        c = 1.0 + odd / c;
        h *= d * c;
        if (std::fabs(d * c - 1.0) < 1e-15) break;
    }
    return h;
}

}  // namespace detail

/// Regularised upper incomplete gamma function Q(a, x), a > 0, x >= 0.
/// Source: Press et al., "Numerical Recipes", section 6.2.
inline double gamma_q(double a, double x) {
    if (!(x > 0.0)) return 1.0;
    if (std::isinf(x)) return 0.0;
    return x < a + 1.0 ? 1.0 - detail::gamma_p_series(a, x) : detail::gamma_q_fraction(a, x);
}

/// Regularised incomplete beta function I_x(a, b), 0 <= x <= 1.
/// Source: Press et al., "Numerical Recipes", section 6.4.
inline double beta_i(double a, double b, double x) {
    if (x <= 0.0) return 0.0;
    if (x >= 1.0) return 1.0;
    const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                  a * std::log(x) + b * std::log1p(-x));
    if (x < (a + 1.0) / (a + b + 2.0)) return front * detail::beta_fraction(a, b, x) / a;
    return 1.0 - front * detail::beta_fraction(b, a, 1.0 - x) / b;
}

/// Probability that a chi-square variable of `dof` degrees of freedom exceeds `x`.
inline double chi_square_tail(double x, double dof) { return gamma_q(0.5 * dof, 0.5 * x); }

/// Probability that a standard normal variable lies farther from 0 than `z`.
inline double normal_tails(double z) { return std::erfc(std::fabs(z) / std::sqrt(2.0)); }

/// Probability that Student's t of `dof` degrees of freedom lies farther from 0 than `t`.
inline double student_tails(double t, double dof) {
    if (std::isinf(t)) return 0.0;
    return beta_i(0.5 * dof, 0.5, dof / (dof + t * t));
}

}  // namespace mirtest
