// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/html_text.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace mir::detail {

/// Styles that all pages share, in light and dark.
inline constexpr const char* html_style = R"(
:root { color-scheme: light dark; --back: #e8e8e8; --text: #1c1c1c; --line: #b0b0b0; }
@media (prefers-color-scheme: dark) {
:root { --back: #242424; --text: #dedede; --line: #555; } }
body { margin: 2rem; background: var(--back); color: var(--text); font: 15px/1.5 sans-serif; }
h1 { font-size: 1.3rem; overflow-wrap: anywhere; }
table { border-collapse: collapse; margin-bottom: 2rem; }
caption { text-align: left; font-weight: bold; padding-bottom: 0.3rem; }
th, td { text-align: left; font-weight: normal; padding: 0.2rem 1.5rem 0.2rem 0;
 border-bottom: 1px solid var(--line); overflow-wrap: anywhere; }
thead th { font-weight: bold; }
td { font-variant-numeric: tabular-nums; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr));
 gap: 1.5rem; }
figure { margin: 0; }
img { width: 100%; height: auto; image-rendering: pixelated; }
)";

/// What a page has beyond title and body. The text of a script is executed only where its SHA-256
/// in base64 is the one given, so nothing in the body can be a script.
struct HtmlExtras {
    std::string_view style;
    std::string_view script;
    std::string_view script_sha256;
};

/// A page up to the start of its element `main`. Nothing but pictures and scripts inside of it may
/// be loaded, whatever its text holds.
inline std::string html_start(const std::string& title, const HtmlExtras& extras = {}) {
    std::string page =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\"\n content=\"default-src 'none'; "
        "img-src data:; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";
    if (!extras.script.empty())
        page += "; script-src 'sha256-" + std::string(extras.script_sha256) + "'";
    page += "\">\n<meta name=\"viewport\" content=\"width=device-width\">\n<style>";
    page += html_style;
    page += extras.style;
    const std::string text = html_escaped(title);
    return page + "</style>\n<title>" + text + "</title>\n</head>\n<body>\n<header><h1>" + text +
           "</h1></header>\n<main>\n";
}

/// A table of plain text. The first cell of a row is its header. `columns` may be empty.
struct HtmlTable {
    std::string caption;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
};

/// What follows the content of `main`.
inline constexpr const char* html_end = "</main>\n</body>\n</html>\n";

inline std::string html_row(const std::vector<std::string>& cells) {
    std::string row = "<tr>";
    for (const std::string& cell : cells)
        row += &cell == &cells.front() ? "<th scope=\"row\">" + html_escaped(cell) + "</th>"
                                       : "<td>" + html_escaped(cell) + "</td>";
    return row + "</tr>\n";
}

inline std::string html_table(const HtmlTable& table) {
    std::string out = "<table>\n<caption>" + html_escaped(table.caption) + "</caption>\n";
    if (!table.columns.empty()) {
        out += "<thead><tr>";
        for (const std::string& column : table.columns)
            out += "<th scope=\"col\">" + html_escaped(column) + "</th>";
        out += "</tr></thead>\n";
    }
    out += "<tbody>\n";
    for (const auto& row : table.rows) out += html_row(row);
    return out + "</tbody>\n</table>\n";
}

}  // namespace mir::detail
