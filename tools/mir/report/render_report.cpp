// SPDX-License-Identifier: MIT
#include "report/render_report.hpp"

#include "mir/compare/comparable.hpp"
#include "mir/io/html_page.hpp"
#include "mir/io/png.hpp"
#include "mir/io/write_file.hpp"
#include "mir/version.hpp"
#include "read_picture.hpp"
#include "render_output.hpp"
#include "report/assets.hpp"
#include "report/sections.hpp"

#include <cstdint>
#include <vector>

namespace mirtool {
namespace {

/// Hexadecimal digits as base64, the form that content security policies want.
std::string base64_of_hex(std::string_view digits) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
        bytes.push_back(
            static_cast<std::uint8_t>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16)));
    return mir::detail::base64(bytes);
}

std::string page_of(const ReportInput& in) {
    const mir::RenderStatistics& s = in.result.statistics;
    std::string page =
        mir::detail::html_start(in.options.scene + " rendered by mir " + mir::version,
                                {report_style, report_script, base64_of_hex(report_script_sha256)});
    page += picture_section(in, preview_look(in.options, in.result.beauty)) +
            warnings_section(in.result) + light_section(in) + reference_section(in) +
            convergence_section(in) + vpls_section(in) + chains_section(s) + timing_section(s);
    page += "<div class=\"rows\">\n<div>" + settings_section(in) + "</div>\n<div>" +
            scene_section(in) + "</div>\n</div>\n";
    page += "<script>" + std::string(report_script) + "</script>\n";
    return page + mir::detail::html_end;
}

}  // namespace

mir::Image<mir::Rgb> read_report_reference(const RenderOptions& o) {
    if (o.report_reference.empty()) return {};
    mir::Image<mir::Rgb> reference = read_picture(o.report_reference).image;
    mir::check_comparable(reference, reference, o.report_reference, o.report_reference);
    return reference;
}

void check_report_reference(const RenderOptions& o, const mir::Image<mir::Rgb>& reference) {
    if (o.report_reference.empty() || reference.extent() == o.settings.image) return;
    throw mir::Error(
        mir::ErrorCode::invalid_input,
        o.report_reference + ": the reference has " + mir::detail::size_text(reference.extent()) +
            " pixels and the picture to render " + mir::detail::size_text(o.settings.image) +
            " (pixels are compared one by one); give --width and --height of the "
            "reference");
}

void write_render_report(const ReportInput& in) {
    if (in.options.report.empty()) return;
    mir::detail::write_file(in.options.report, page_of(in), "the report");
}

}  // namespace mirtool
