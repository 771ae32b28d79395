// SPDX-License-Identifier: MIT
#include "mir/io/html_report.hpp"

#include "mir/core/error.hpp"
#include "mir/io/html_page.hpp"
#include "mir/io/png.hpp"
#include "mir/io/write_file.hpp"

namespace mir {

namespace detail {
namespace {

std::string html_figure(const HtmlFigure& figure, const std::filesystem::path& path) {
    const std::string caption = html_escaped(figure.caption);
    return "<figure><img alt=\"" + caption + "\" width=\"" +
           std::to_string(figure.picture->width()) + "\" height=\"" +
           std::to_string(figure.picture->height()) + "\" src=\"data:image/png;base64," +
           base64(encode_png(*figure.picture, {figure.exposure_ev}, path)) + "\"><figcaption>" +
           caption + "</figcaption></figure>\n";
}

std::string html_page(const HtmlReport& report, const std::filesystem::path& path) {
    std::string page = html_start(report.title);
    HtmlTable table{"Metrics", {}, {}};
    for (const auto& [label, value] : report.rows) table.rows.push_back({label, value});
    page += html_table(table) + "<div class=\"figures\">\n";
    for (const HtmlFigure& figure : report.figures) page += html_figure(figure, path);
    return page + "</div>\n" + html_end;
}

}  // namespace
}  // namespace detail

void write_html_report(const std::filesystem::path& path, const HtmlReport& report) {
    for (const HtmlFigure& figure : report.figures)
        expects(figure.picture != nullptr && figure.picture->extent().area() > 0,
                "a report was given a figure without picture (it would be broken); leave it out");
    detail::write_file(path, detail::html_page(report, path), "the report");
}

}  // namespace mir
