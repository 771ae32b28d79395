// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/unit_circle.hpp"
#include "mir/film/filter_options.hpp"

#include <array>
#include <cmath>
#include <string>
#include <string_view>

namespace mir {

/// sin(pi x), absolute error below 2e-7 for |x| < 2^20, exactly zero at integers. libm's sine of a
/// rounded pi is not.
constexpr float sin_pi(float x) { return unit_circle(0.5f * x).y; }

/// sin(pi x) / (pi x), 1 at 0.
constexpr float sinc(float x) {
    const float d = x < 0.0f ? -x : x;
    return d < 1e-4f ? 1.0f : sin_pi(d) / (pi * d);
}

namespace detail {

/// sinc(x) sinc(u) with a single division; `x` and `u` are not negative.
constexpr float lanczos_weight(float x, float u) {
    if (u < 1e-4f) return sinc(x);
    return sin_pi(x) * sin_pi(u) / (pi * pi * x * u);
}

/// `x` in [0, 2]. Source: Mitchell and Netravali 1988, equation 8 with B = C = 1/3.
constexpr float mitchell_weight(float x) {
    if (x < 1.0f) return ((7.0f * x - 12.0f) * x * x + 16.0f / 3.0f) / 6.0f;
    return (2.0f - x) * (2.0f - x) * (8.0f - 7.0f * x) / 18.0f;
}

}  // namespace detail

inline float Filter::along(float d) const {
    d = std::fabs(d);
    if (!(d < half_width)) return kind == FilterKind::box && d == half_width ? 0.5f : 0.0f;
    switch (kind) {
        case FilterKind::box:
            return 1.0f;
        case FilterKind::tent:
            return 1.0f - d / half_width;
        case FilterKind::gaussian:
            return larger(0.0f,
                          std::exp(-2.0f * d * d) - std::exp(-2.0f * half_width * half_width));
        case FilterKind::mitchell:
            return detail::mitchell_weight(2.0f * d / half_width);
        case FilterKind::lanczos:
            return detail::lanczos_weight(d * tau / half_width, d / half_width);
    }
    return 0.0f;
}

inline float Filter::operator()(float dx, float dy) const { return along(dx) * along(dy); }

/// A kind and its name on the command line and in files.
struct FilterName {
    std::string_view name;  ///< in lower case
    FilterKind kind;        ///< what it names
};

/// Every filter there is.
inline constexpr std::array<FilterName, 5> filter_names{{{"box", FilterKind::box},
                                                         {"tent", FilterKind::tent},
                                                         {"gaussian", FilterKind::gaussian},
                                                         {"mitchell", FilterKind::mitchell},
                                                         {"lanczos", FilterKind::lanczos}}};

/// Name of a kind, "lanczos" for FilterKind::lanczos and so on.
constexpr std::string_view to_string(FilterKind kind) {
    for (const FilterName& entry : filter_names)
        if (entry.kind == kind) return entry.name;
    return "unknown";
}

/// The filter called `name`, with its usual half-width.
/// @throws Error(invalid_argument) that lists the names, when there is none.
inline Filter filter_named(std::string_view name) {
    std::string known;
    for (const FilterName& entry : filter_names) {
        if (entry.name == name) return default_filter(entry.kind);
        known += known.empty() ? "" : ", ";
        known += entry.name;
    }
    throw Error(ErrorCode::invalid_argument, "there is no pixel filter '" + std::string(name) +
                                                 "' (the name is not known); use one of " + known);
}

}  // namespace mir
