// SPDX-License-Identifier: MIT
#pragma once

#include "report/render_report.hpp"

#include <string>

namespace mirtool {

/// Circles at the VPLs as the camera sees them, as SVG over the picture. The area is proportional
/// to the power in luminance, the colour tells the main bounce, those behind a surface are faint.
/// The strongest `most_drawn_vpls` inside of the picture. Hidden until the reader asks for them;
/// empty without VPLs.
std::string vpl_drawing(const ReportInput& input);
inline constexpr std::size_t most_drawn_vpls = 4000;

/// The switch for them, and the choice of a bounce.
std::string vpl_controls(const ReportInput& input);

/// What colours mean.
std::string vpl_legend(const ReportInput& input);

}  // namespace mirtool
