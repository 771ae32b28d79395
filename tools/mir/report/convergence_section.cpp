// SPDX-License-Identifier: MIT
#include "mir/io/html_page.hpp"
#include "report/log_chart.hpp"
#include "report/sections.hpp"
#include "text.hpp"

#include <vector>

namespace mirtool {
namespace {

using Error = std::optional<double> ConvergencePoint::*;

struct ErrorKind {
    const char* name;
    Error error;
};

constexpr ErrorKind error_kinds[] = {
    {"estimated from the spread of passes", &ConvergencePoint::spread_error},
    {"against the reference", &ConvergencePoint::reference_error}};

/// Errors in percent over what `x` says of a point.
template <class X>
LogChart chart_of(const std::vector<ConvergencePoint>& points, bool reference,
                  const std::string& quantity, const X& x) {
    LogChart chart{"Error against " + quantity + ", both axes logarithmic",
                   quantity,
                   "Relative error in percent",
                   {}};
    for (const ErrorKind& kind : error_kinds) {
        if (!reference && kind.error == &ConvergencePoint::reference_error) continue;
        LogSeries series{kind.name, {}};
        for (const ConvergencePoint& p : points)
            if (p.*kind.error) series.points.push_back({x(p), 100.0 * *(p.*kind.error)});
        chart.series.push_back(std::move(series));
    }
    return chart;
}

std::string error_text(const std::optional<double>& error) {
    return error ? fixed(100.0 * *error, 2) + " %" : "unknown";
}

std::string table(const std::vector<ConvergencePoint>& points, bool reference) {
    mir::detail::HtmlTable table{"Error of the mean of passes, relative to its brightness",
                                 {"Passes", "VPLs", "Seconds", "Error by spread"},
                                 {}};
    if (reference) table.columns.emplace_back("Error by reference");
    for (const ConvergencePoint& p : points) {
        table.rows.push_back({std::to_string(p.passes), std::to_string(p.vpls), fixed(p.seconds, 2),
                              error_text(p.spread_error)});
        if (reference) table.rows.back().push_back(error_text(p.reference_error));
    }
    return mir::detail::html_table(table);
}

}  // namespace

std::string convergence_section(const ReportInput& in) {
    const std::vector<ConvergencePoint>& points = in.convergence.points();
    if (points.empty()) return "";
    const bool reference = in.reference.extent().area() > 0;
    const bool vpls = points.back().vpls > 0;
    const auto by_count = [&](const ConvergencePoint& p) {
        return static_cast<double>(vpls ? p.vpls : p.passes);
    };
    const auto by_time = [](const ConvergencePoint& p) { return p.seconds; };
    return "<h2>Convergence</h2>\n<div class=\"figures\">\n" +
           log_chart(
               chart_of(points, reference, vpls ? "VPLs of all passes" : "Passes", by_count)) +
           log_chart(chart_of(points, reference, "Seconds of rendering", by_time)) + "</div>\n" +
           table(points, reference);
}

}  // namespace mirtool
