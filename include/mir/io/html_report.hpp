// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mir {

/// A picture of a report, linear light. `picture` is not owned and must outlive the call that
/// writes it.
struct HtmlFigure {
    std::string caption;  ///< below the picture, and in its place for who cannot see it
    const Image<Rgb>* picture = nullptr;  ///< not null, at least one pixel
    float exposure_ev = 0.0f;             ///< as of write_png()
};

/// A page with a table of two columns and pictures. All text is plain; the page escapes it.
struct HtmlReport {
    std::string title;                                      ///< of the window, and heading
    std::vector<std::pair<std::string, std::string>> rows;  ///< label and value
    std::vector<HtmlFigure> figures;                        ///< in the order of the page
};

/// Writes a report as one self-contained HTML file. It needs nothing else, no network either. It
/// follows the reader's choice of light or dark. Equal input gives equal bytes; the file replaces
/// an older one only when complete.
/// @throws Error(io) when the file cannot be written, Error(invalid_argument) for a missing or
///         empty picture.
void write_html_report(const std::filesystem::path& path, const HtmlReport& report);

}  // namespace mir
