// SPDX-License-Identifier: MIT
#pragma once

namespace mir::validation::detail {

/// The larger of two errors; NaN, which std::max may lose, when either is NaN.
constexpr double worse(double a, double b) { return b > a || b != b ? b : a; }

}  // namespace mir::validation::detail
