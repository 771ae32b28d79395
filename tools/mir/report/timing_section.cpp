// SPDX-License-Identifier: MIT
#include "mir/io/html_page.hpp"
#include "report/sections.hpp"
#include "text.hpp"

#include <algorithm>
#include <vector>

namespace mirtool {
namespace {

struct Stage {
    std::string name;
    double seconds;
};

/// A bar of the chart with its name and number. `row` counts from 0, lengths are in its pixels.
std::string bar(const Stage& stage, std::size_t row, double longest) {
    constexpr double room = 480.0;
    const double length = std::max(1.0, room * stage.seconds / longest);
    const std::string y = std::to_string(22 * row);
    const std::string base = std::to_string(22 * row + 15);
    return R"(<text x="110" y=")" + base + R"(" text-anchor="end">)" + stage.name +
           R"(</text><rect x="118" y=")" + y + "\" width=\"" + fixed(length, 1) +
           R"(" height="18"/><text x=")" + fixed(124.0 + length, 1) + "\" y=\"" + base + "\">" +
           fixed(stage.seconds, 3) + " s</text>\n";
}

std::string chart(const std::vector<Stage>& stages, double longest) {
    const std::string height = std::to_string(22 * stages.size());
    std::string svg = R"(<svg class="chart" role="img" aria-label="Bars of the seconds by )"
                      "stage; the table below has the numbers\" viewBox=\"0 0 690 " +
                      height + "\">\n";
    for (std::size_t i = 0; i < stages.size(); ++i) svg += bar(stages[i], i, longest);
    return svg + "</svg>\n";
}

}  // namespace

std::string timing_section(const mir::RenderStatistics& s) {
    std::vector<Stage> stages;
    mir::detail::HtmlTable table{"Wall time by stage", {"Stage", "Seconds", "Share"}, {}};
    double longest = 0.0;
    for (const mir::RenderStage& stage : mir::render_stages) {
        const double seconds = s.seconds.*stage.seconds;
        if (seconds <= 0.0) continue;
        stages.push_back({std::string(stage.name), seconds});
        longest = std::max(longest, seconds);
        table.rows.push_back(
            {stages.back().name, fixed(seconds, 4), percent(seconds / s.seconds.total)});
    }
    table.rows.push_back({"total", fixed(s.seconds.total, 4), percent(1.0)});
    std::string section = "<h2>Time</h2>\n";
    if (!stages.empty()) section += chart(stages, longest);
    return section + mir::detail::html_table(table);
}

}  // namespace mirtool
