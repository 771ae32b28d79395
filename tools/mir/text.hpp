// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/printable.hpp"

#include <array>
#include <cstddef>
#include <cstdio>
#include <string>

namespace mirtool {

/// A number in up to six digits.
inline std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

/// A number with `digits` behind the point.
inline std::string fixed(double value, int digits) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    return text.data();
}

/// "(1.5, 2, -3)", each number in up to `digits` digits. 15 tell every Scene::origin.
inline std::string place(mir::DVec3 v, int digits = 15) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "(%.*g, %.*g, %.*g)", digits, v.x, digits, v.y, digits,
                  v.z);
    return text.data();
}

/// A name of a file or of something in one, as a terminal may show it.
inline std::string shown(const std::string& name) {
    constexpr std::size_t longest = 1000;
    return mir::printable(name, longest);
}

/// A share of 0..1 in percent.
inline std::string percent(double share) { return fixed(100.0 * share, 1) + " %"; }

}  // namespace mirtool
