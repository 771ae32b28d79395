// SPDX-License-Identifier: MIT
#include "paper_numbers.hpp"
#include "report.hpp"

#include <algorithm>
#include <cstdio>
#include <map>

namespace mirpaper {
namespace {

std::string with_decimals(int decimals, double x) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, x);
    return text;
}

std::string with_digits(int digits, double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, x);
    return text;
}

std::string time_text(double seconds) {
    if (seconds >= 1.0) return with_decimals(seconds >= 10.0 ? 0 : 1, seconds) + " s";
    return with_digits(3, 1e3 * seconds) + " ms";
}

std::string rate_text(double per_second) {
    return per_second >= 1e9 ? with_digits(3, 1e-9 * per_second) + " G"
                             : with_digits(3, 1e-6 * per_second) + " M";
}

std::string percent(double share) { return with_decimals(1, 100.0 * share) + " %"; }

/// A table whose rows and columns appear as their labels are first used.
class Table {
 public:
    explicit Table(std::string corner) : corner_(std::move(corner)) {}

    void set(const std::string& row, const std::string& column, const std::string& text) {
        note(rows_, row);
        note(columns_, column);
        cells_[{row, column}] = text;
    }

    [[nodiscard]] std::string markdown() const {
        std::string text = "| " + corner_ + " |";
        for (const std::string& c : columns_) text += " " + c + " |";
        text += "\n|---|";
        for (std::size_t i = 0; i < columns_.size(); ++i) text += "---|";
        text += "\n";
        for (const std::string& r : rows_) {
            text += "| " + r + " |";
            for (const std::string& c : columns_) text += " " + cell(r, c) + " |";
            text += "\n";
        }
        return text;
    }

 private:
    static void note(std::vector<std::string>& labels, const std::string& label) {
        if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
    }
    [[nodiscard]] std::string cell(const std::string& row, const std::string& column) const {
        const auto found = cells_.find({row, column});
        return found == cells_.end() ? "" : found->second;
    }

    std::string corner_;
    std::vector<std::string> rows_;
    std::vector<std::string> columns_;
    std::map<std::pair<std::string, std::string>, std::string> cells_;
};

const std::string paper_label = "2009, GTX 280";

std::string method_of(const Row& row) {
    return row.algorithm + (row.variant.empty() ? "" : ", " + row.variant);
}

std::string time_and_rate(const Row& row) {
    return time_text(row.seconds.median) + " (" + rate_text(row.rate()) + ")";
}

std::string vpls_of(const Row& row) { return std::to_string(row.vpls) + " VPLs"; }

using Rows = std::vector<Row>;

/// The paper's algorithms across, backends down.
std::string figure_8(const Rows& rows) {
    Table table("scene, backend");
    for (const Row& row : rows) {
        const std::string column = method_of(row);
        if (row.paper_seconds > 0.0)
            table.set(row.scene + ", " + paper_label, column, time_text(row.paper_seconds));
        table.set(row.scene + ", " + row.backend + ", " + vpls_of(row), column, time_and_rate(row));
    }
    return table.markdown();
}

/// Algorithms down, scenes across.
std::string figure_9(const Rows& rows) {
    Table table("algorithm");
    for (const Row& row : rows) {
        if (row.paper_seconds > 0.0)
            table.set(row.algorithm + ", " + paper_label, row.scene, time_text(row.paper_seconds));
        table.set(method_of(row) + ", " + row.backend + ", " + vpls_of(row), row.scene,
                  time_and_rate(row));
    }
    return table.markdown();
}

/// Contributions per second: VPLs and algorithms down, scenes across.
std::string peak_rates(const Rows& rows) {
    Table table("contributions/s");
    for (const Row& row : rows)
        if (row.paper_contributions > 0.0)
            table.set(paper_label + ", peak", row.scene, rate_text(row.paper_contributions));
    for (const Row& row : rows)
        table.set(vpls_of(row) + ", " + method_of(row) + ", " + row.backend, row.scene,
                  rate_text(row.rate()));
    return table.markdown();
}

std::string figure_11(const Rows& rows) {
    Table table("algorithm");
    for (const Row& row : rows) {
        const std::string tile = row.tile == row.image ? "whole image" : text_of(row.tile);
        if (row.paper_seconds > 0.0)
            table.set(row.scene + ", " + row.algorithm + ", " + paper_label, tile,
                      time_text(row.paper_seconds));
        table.set(row.scene + ", " + method_of(row) + ", " + row.backend + ", " + vpls_of(row),
                  tile, time_text(row.seconds.median));
    }
    return table.markdown();
}

std::string stage_table(const Rows& rows) {
    Table table("scene, algorithm, backend");
    for (const Row& row : rows) {
        const std::string label =
            row.scene + ", " + row.algorithm + ", " + row.backend + ", " + vpls_of(row);
        const StageSeconds& s = *row.stages;
        for (std::size_t i = 0; i < work_names.size(); ++i)
            if (static_cast<Work>(i) != Work::other)
                table.set(label, work_names[i], s.of[i] > 0.0 ? time_text(s.of[i]) : "");
        table.set(label, "sum", time_text(s.sum()));
        table.set(label, "busy", time_text(s.busy));
        table.set(label, "from first to last", time_text(s.span));
        table.set(label, "overlap", percent(s.overlap()));
        table.set(label, "copies behind kernels", percent(s.hidden_transfer()));
        table.set(label, "untraced", time_text(row.seconds.median));
        table.set(label, "whole call", time_text(row.wall.median));
    }
    return table.markdown();
}

std::string luxel_table(const Rows& rows) {
    Table table("G-buffer");
    for (const Row& row : rows)
        table.set(row.algorithm + ", " + row.backend, row.scene, time_text(row.seconds.median));
    return table.markdown();
}

std::string kernel_table(const Rows& rows) {
    Table table("kernels, contributions/s");
    for (const Row& row : rows) {
        std::string text = rate_text(row.rate());
        if (row.visibility_seconds > 0.0)
            text += " (rays " + time_text(row.visibility_seconds) + ", shading " +
                    time_text(row.shading_seconds) + ")";
        table.set(method_of(row) + ", " + row.backend + ", " + vpls_of(row), row.scene, text);
    }
    return table.markdown();
}

std::string shaft_table(const Rows& rows) {
    Table table("scene, kernels");
    for (const Row& row : rows) {
        const std::string label =
            row.scene + ", " + method_of(row) + ", " + row.backend + ", " + vpls_of(row);
        table.set(label, "contributions/s", rate_text(row.rate()));
        table.set(label, "all", time_text(row.seconds.median));
        for (const Work w : {Work::order, Work::records, Work::facing, Work::blocks, Work::clusters,
                             Work::lists, Work::segments, Work::shading})
            table.set(label, work_names[static_cast<std::size_t>(w)],
                      row.stages ? time_text(row.stages->of[static_cast<std::size_t>(w)]) : "");
    }
    return table.markdown();
}

std::string counter_table(const Rows& rows) {
    Table table("per ray");
    for (const Row& row : rows) {
        const RayCounters& c = *row.counters;
        const std::string column = row.scene + ", " + vpls_of(row);
        table.set("pairs that face each other", column, percent(c.facing));
        table.set("of those, visible", column, percent(c.visible));
        table.set("inner nodes", column, with_decimals(1, c.nodes));
        table.set("leaves", column, with_decimals(1, c.leaves));
        table.set("triangles tested", column, with_decimals(1, c.triangles));
        table.set("lanes busy in lock step", column, percent(c.lanes_busy));
    }
    return table.markdown();
}

struct Section {
    const char* figure;
    const char* title;
    std::string (*table)(const Rows&);
};

constexpr std::array<Section, 10> sections{{
    {"8", "Figure 8: the four algorithms", figure_8},
    {"9", "Figure 9: RC and RCVP on three scenes, direct and indirect", figure_9},
    {"10", "Figure 10: contributions per second against VPLs", peak_rates},
    {"11", "Figure 11: tile sizes", figure_11},
    {"rates", "Contributions per second, with and without copies", peak_rates},
    {"stages", "Where the time goes", stage_table},
    {"luxels", "Luxels copied to the backend, and traced there", luxel_table},
    {"kernels", "Kernels alone, one change at a time", kernel_table},
    {"shafts", "Shafts against rays, kernels alone", shaft_table},
    {"counters", "What a shadow ray does", counter_table},
}};

std::string scene_table(const std::vector<SceneNote>& scenes) {
    Table table("scene");
    for (const SceneNote& s : scenes) {
        table.set(s.name, "triangles", std::to_string(s.triangles));
        table.set(s.name, "hash", s.hash);
        table.set(s.name, "kd-tree", time_text(s.tree_seconds));
        table.set(s.name, "SAH cost", with_decimals(1, s.tree_sah_cost));
        table.set(s.name, "MiB", with_decimals(1, static_cast<double>(s.tree_bytes) / 1048576.0));
    }
    return table.markdown();
}

}  // namespace

std::string markdown_of(const Results& results) {
    std::string text = text_of(results.image) + " luxels; median of " +
                       std::to_string(results.repeat) + " warm runs, of " +
                       std::to_string(results.host_repeat) + " where the host traces.\n";
    for (const std::string& device : results.devices) text += "\n* " + device;
    text += "\n\n### Scenes\n\n" + scene_table(results.scenes);
    for (const Section& section : sections) {
        Rows rows = results.rows;
        std::erase_if(rows, [&](const Row& row) { return row.figure != section.figure; });
        if (rows.empty()) continue;
        text += std::string("\n### ") + section.title + "\n\n" + section.table(rows);
    }
    return text;
}

}  // namespace mirpaper
