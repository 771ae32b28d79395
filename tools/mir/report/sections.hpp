// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/png.hpp"
#include "report/render_report.hpp"

#include <cstddef>
#include <string>

namespace mirtool {

// Parts of the page of --report, as HTML; empty where there is nothing to tell. Each starts with
// its heading.

/// The picture with its layers on real radiance, controls and VPLs, and the signed error.
/// `look` is what it begins with.
std::string picture_section(const ReportInput& input, const mir::PreviewLook& look);

/// The numbers of the difference from the reference.
std::string reference_section(const ReportInput& input);

/// What the result gives reason to say, in words.
std::string warnings_section(const mir::RenderResult& result);

/// What the light is made of, who brought it, and what is missing.
std::string light_section(const ReportInput& input);

/// VPLs by bounce.
std::string vpls_section(const ReportInput& input);

/// What Markov chains say about themselves.
std::string chains_section(const mir::RenderStatistics& statistics);

/// The error of several passes over VPLs and seconds, as charts and table.
std::string convergence_section(const ReportInput& input);

/// Seconds by stage, as bars and as a table.
std::string timing_section(const mir::RenderStatistics& statistics);

/// What was asked for and what did it.
std::string settings_section(const ReportInput& input);

/// What the scene holds.
std::string scene_section(const ReportInput& input);

}  // namespace mirtool
