// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

namespace mir {

/// Checks a bound of geometry terms, m^-2.
/// @throws Error(invalid_argument) when it is negative or not a number.
inline void check_bound(float bound, Where at = Where::here()) {
    expects(bound >= 0.0f,
            "a bound of geometry terms is negative or not a number (they are never below 0); give "
            "0 or more, the largest float for none",
            at);
}

/// Checks the bound of a shading that has one, such as VplShading.
/// @throws Error as check_bound().
template <class F>
void check_shading(const F& shading, Where at = Where::here()) {
    if constexpr (requires { shading.bound; }) check_bound(shading.bound, at);
}

}  // namespace mir
