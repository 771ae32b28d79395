// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/io/scene_report.hpp"
#include "mir/scene/texture_image.hpp"

#include <cmath>
#include <cstddef>
#include <string>

namespace mir::detail {

/// Complains about one place of a file; the reader puts the file's name in front.
[[noreturn]] inline void fail_at(const std::string& place, const std::string& problem,
                                 ErrorCode code = ErrorCode::invalid_input) {
    throw Error(code, place + ": " + problem);
}

/// A finite number that fits a float.
inline float checked_float(double value, const char* what, const std::string& place) {
    const auto narrow = static_cast<float>(value);
    if (!std::isfinite(narrow))
        fail_at(place, std::string(what) + " is not a finite number (" + std::to_string(value) +
                           " does not fit 32 bits); repair the value");
    return narrow;
}

/// A finite number that is not negative.
inline float checked_amount(double value, const char* what, const std::string& place) {
    const float narrow = checked_float(value, what, place);
    if (narrow < 0.0f)
        fail_at(place, std::string(what) + " is negative (" + std::to_string(value) +
                           "; light and lengths cannot be); repair the value");
    return narrow;
}

/// A factor of 0..1. Values outside are clamped and counted: exporters round past the ends.
inline float unit_factor(double value, const char* what, const std::string& place,
                         SceneReport& report) {
    const float narrow = checked_float(value, what, place);
    if (narrow >= 0.0f && narrow <= 1.0f) return narrow;
    ++report.ignored[std::string(what).append(" outside 0..1 (clamped)")];
    return narrow < 0.0f ? 0.0f : 1.0f;
}

/// A colour of three sRGB codes of 0..1.
inline Rgb linear_color(double r, double g, double b, const char* what, const std::string& place,
                        SceneReport& report) {
    const auto channel = [&](double code) {
        return srgb_to_linear(double{unit_factor(code, what, place, report)});
    };
    return {channel(r), channel(g), channel(b)};
}

}  // namespace mir::detail
