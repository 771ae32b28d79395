// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/number_text.hpp"
#include "mir/core/printable.hpp"
#include "mir/io/visible_effect.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace mirtool {

/// A number in up to six digits.
inline std::string number(double value) { return mir::number_text(value); }

/// A number with `digits` behind the point.
inline std::string fixed(double value, int digits) { return mir::fixed_text(value, digits); }

/// "(1.5, 2, -3)", each number in up to `digits` digits. 15 tell every Scene::origin.
inline std::string place(mir::DVec3 v, int digits = 15) {
    return "(" + mir::number_text(v.x, digits) + ", " + mir::number_text(v.y, digits) + ", " +
           mir::number_text(v.z, digits) + ")";
}

/// A name of or in a file, as a terminal may show it.
inline std::string shown(const std::string& name) {
    constexpr std::size_t longest = 1000;
    return mir::printable(name, longest);
}

/// An entry of SceneReport::ignored and what one sees of it.
inline std::string ignored_text(const std::string& what, std::uint64_t times) {
    return what + " (" + std::to_string(times) + "): " + mir::visible_effect(what);
}

/// A share of 0..1 in percent.
inline std::string percent(double share) { return fixed(100.0 * share, 1) + " %"; }

}  // namespace mirtool
