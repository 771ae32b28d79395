// SPDX-License-Identifier: MIT
#include "mir/compare/metrics.hpp"
#include "mir/io/html_page.hpp"
#include "report/sections.hpp"
#include "text.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace mirtool {
namespace {

std::string rate_text(const mir::MutationCount& m) {
    if (m.proposed == 0) return "none proposed";
    return percent(m.rate()) + " of " + std::to_string(m.proposed);
}

std::string luminance_text(const mir::PathLuminance& p) {
    if (p.paths == 0) return "not measured";
    return number(p.mean) + " ± " + number(p.standard_error) + " W/(m² sr), " +
           std::to_string(p.contributing) + " of " + std::to_string(p.paths) +
           " paths carried light";
}

/// The second estimate of P_c, and what it says about the first.
std::vector<std::string> second_luminance_row(const mir::ChainHealth& h) {
    const bool known = h.luminance.paths > 0 && h.large_step_luminance.paths > 0;
    return {"P_c of the large steps", luminance_text(h.large_step_luminance),
            known ? "a second estimate, " + fixed(std::fabs(h.luminance_z()), 1) +
                        " standard errors away; beyond 4 light is missed"
                  : "a second estimate"};
}

std::string r_hat_text(double r_hat) {
    return std::isfinite(r_hat) ? number(r_hat) : "too few states to tell";
}

std::string mean_text(const std::array<double, 3>& mean) {
    return number(mean[0]) + ", " + number(mean[1]) + ", " + number(mean[2]);
}

std::string metrics_table(const std::string& caption, const mir::Image<mir::Rgb>& picture,
                          const mir::Image<mir::Rgb>& reference) {
    const mir::ImageMetrics m = mir::compare_images(picture, reference);
    return mir::detail::html_table(
        {caption,
         {},
         {{"RMSE", number(m.rmse()) + " W/(m² sr)"},
          {"relMSE", number(m.rel_mse) + " (epsilon " + number(mir::default_rel_mse_epsilon) + ")"},
          {"MAE", number(m.mae) + " W/(m² sr)"},
          {"mean R, G, B", mean_text(m.mean)},
          {"mean of reference", mean_text(m.reference_mean)},
          {"largest difference of means", percent(m.mean_difference())}}});
}

}  // namespace

std::string warnings_section(const mir::RenderResult& result) {
    std::string section = "<h2>Warnings</h2>\n";
    if (result.warnings.empty()) return section + "<p>The render gave no reason to warn.</p>\n";
    section += "<ul class=\"warnings\">\n";
    for (const std::string& warning : result.warnings)
        section += "<li>" + mir::detail::html_escaped(warning) + "</li>\n";
    return section + "</ul>\n";
}

std::string chains_section(const mir::RenderStatistics& s) {
    if (!s.health) return "";
    const mir::ChainHealth& h = *s.health;
    const std::string states = std::to_string(h.recorded_states);
    return "<h2>Markov chains</h2>\n" +
           mir::detail::html_table(
               {"What " + std::to_string(h.chains) + " chains of " + std::to_string(h.mutations) +
                    " mutations say about themselves",
                {"Quantity", "Value", "What it tells"},
                {{"large steps accepted", rate_text(h.large), "independent new paths"},
                 {"small steps accepted", rate_text(h.small),
                  "changed random numbers; near 0 or 1 the steps are too large or too small"},
                 {"bidirectional mutations accepted", rate_text(h.bidirectional),
                  "parts of the path replaced"},
                 {"suffix refreshes accepted", rate_text(h.suffix),
                  "new light behind a VPL that stays"},
                 {"longest stay", std::to_string(h.longest_stay) + " mutations",
                  "most rejected in a row"},
                 {"recorded states",
                  states + ", " + std::to_string(h.distinct_vpls) + " distinct VPLs",
                  "what the VPLs are made of"},
                 {"effective samples", number(std::round(h.effective_samples)) + " of " + states,
                  "what the states are worth in independent ones; all of them is ideal"},
                 {"split R-hat", r_hat_text(h.split_r_hat),
                  "disagreement of the chains; 1 is ideal"},
                 {"P_c", luminance_text(h.luminance),
                  "mean luminance of all paths, a common factor of the VPLs' light"},
                 second_luminance_row(h),
                 {"dropped share", percent(s.dropped_share),
                  "states whose VPL lights no luxel; their light is lost"}}});
}

std::string reference_section(const ReportInput& in) {
    if (in.reference.extent().area() == 0) return "";
    const std::string of = " against " + in.options.report_reference;
    std::string section = "<h2>Difference from the reference</h2>\n" +
                          metrics_table("Beauty" + of, in.result.beauty, in.reference);
    if (!in.result.denoised.pixels().empty())
        section +=
            metrics_table("Beauty by " + in.result.denoiser + of, in.result.denoised, in.reference);
    return section;
}

}  // namespace mirtool
