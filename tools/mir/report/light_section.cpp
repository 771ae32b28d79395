// SPDX-License-Identifier: MIT
#include "mir/io/html_page.hpp"
#include "mir/runtime/light_budget.hpp"
#include "report/sections.hpp"
#include "text.hpp"

namespace mirtool {
namespace {

/// Three digits of what is small.
std::string small_percent(double share, double error) {
    return mir::number_text(100.0 * share, 3) + " ± " + mir::number_text(100.0 * error, 1) + " %";
}

std::string missing_text(const mir::LightClass& c) {
    std::string text;
    for (const mir::MissingLight& m : c.missing)
        text += (text.empty() ? "" : ", ") + small_percent(m.share.share, m.share.standard_error) +
                " by " + m.why;
    return text;
}

}  // namespace

std::string light_section(const ReportInput& in) {
    mir::detail::HtmlTable table{"What the light of the picture is made of",
                                 {"Light", "Share", "Brought by", "Missing of it"},
                                 {}};
    for (const mir::LightClass& c : mir::light_budget(in.result, in.options.settings))
        table.rows.push_back({c.light,
                              c.standard_error ? small_percent(c.share, *c.standard_error)
                                               : mir::number_text(100.0 * c.share, 3) + " %",
                              c.brought_by, missing_text(c)});
    return "<h2>Light</h2>\n" + mir::detail::html_table(table);
}

}  // namespace mirtool
