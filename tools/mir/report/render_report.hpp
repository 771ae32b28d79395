// SPDX-License-Identifier: MIT
#pragma once

#include "convergence.hpp"
#include "load_scene.hpp"
#include "mir/runtime/result.hpp"
#include "options.hpp"

namespace mirtool {

/// What a report tells of; a view.
struct ReportInput {
    const RenderOptions& options;  ///< its settings as rendered
    const SceneAndReport& loaded;
    const mir::RenderResult& result;
    const mir::Image<mir::Rgb>& reference;  ///< empty: none
    const Convergence& convergence;         ///< of a single pass nothing
};

/// The picture of --report-reference; empty without that option.
/// @throws mir::Error(invalid_input or unsupported) when it cannot be read or has a value that is
///         none.
mir::Image<mir::Rgb> read_report_reference(const RenderOptions& options);

/// @throws mir::Error(invalid_input) unless the reference, if there is one, has the size to render.
void check_report_reference(const RenderOptions& options, const mir::Image<mir::Rgb>& reference);

/// Writes the page of --report: one HTML file that loads nothing, below 5 MB. Does nothing without
/// that option. The page appears complete or not at all.
/// @throws mir::Error(io) when it cannot be written.
void write_render_report(const ReportInput& input);

}  // namespace mirtool
