// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/data/image.hpp"
#include "mir/io/html_page.hpp"
#include "mir/io/png.hpp"
#include "mir/io/write_file.hpp"

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

namespace detail {

inline std::string html_figure(const HtmlFigure& figure, const std::filesystem::path& path) {
    const std::string caption = html_escaped(figure.caption);
    return "<figure><img alt=\"" + caption + "\" width=\"" +
           std::to_string(figure.picture->width()) + "\" height=\"" +
           std::to_string(figure.picture->height()) + "\" src=\"data:image/png;base64," +
           base64(encode_png(*figure.picture, {figure.exposure_ev}, path)) + "\"><figcaption>" +
           caption + "</figcaption></figure>\n";
}

inline std::string html_page(const HtmlReport& report, const std::filesystem::path& path) {
    std::string page = html_start(report.title);
    HtmlTable table{"Metrics", {}, {}};
    for (const auto& [label, value] : report.rows) table.rows.push_back({label, value});
    page += html_table(table) + "<div class=\"figures\">\n";
    for (const HtmlFigure& figure : report.figures) page += html_figure(figure, path);
    return page + "</div>\n" + html_end;
}

}  // namespace detail

/// Writes a report as one HTML file that holds its pictures and needs nothing else, no network
/// either. It follows the reader's choice of light or dark. Equal input gives equal bytes; the file
/// replaces an older one only when complete.
/// @throws Error(io) when the file cannot be written, Error(invalid_argument) for a missing or
///         empty picture.
inline void write_html_report(const std::filesystem::path& path, const HtmlReport& report) {
    for (const HtmlFigure& figure : report.figures)
        expects(figure.picture != nullptr && figure.picture->extent().area() > 0,
                "a report was given a figure without picture (it would be broken); leave it out");
    detail::write_file(path, detail::html_page(report, path), "the report");
}

}  // namespace mir
