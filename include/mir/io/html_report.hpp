// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/data/image.hpp"
#include "mir/io/atomic_file.hpp"
#include "mir/io/png.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace mir {

/// A picture of a report, linear light. `picture` is not owned and must outlive the call that
/// writes it.
struct HtmlFigure {
    std::string caption;
    const Image<Rgb>* picture = nullptr;
    float exposure_ev = 0.0f;  ///< as of write_png()
};

/// A page with a table of two columns and pictures. All text is plain; the page escapes it.
struct HtmlReport {
    std::string title;
    std::vector<std::pair<std::string, std::string>> rows;  ///< label and value
    std::vector<HtmlFigure> figures;
};

namespace detail {

/// Text that no reader of HTML takes for markup, neither in elements nor in quoted attributes.
inline std::string html_escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

/// Base64 of RFC 4648, padded.
inline std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr const char* letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < n ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += k <= n ? letters[word >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

inline std::vector<std::uint8_t> png_bytes(const HtmlFigure& figure,
                                           const std::filesystem::path& path) {
    const float scale = std::exp2(figure.exposure_ev);
    std::vector<std::uint8_t> codes;
    codes.reserve(figure.picture->pixels().size() * 3);
    for (const Rgb& pixel : figure.picture->pixels())
        for (const float value : {pixel.r, pixel.g, pixel.b})
            codes.push_back(to_srgb8(value * scale));
    return encode_png(figure.picture->extent(), codes, path);
}

/// Start of the page. Nothing but its own pictures may be loaded, whatever its text holds.
inline constexpr const char* html_head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy"
 content="default-src 'none'; img-src data:; style-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width">
<style>
:root { color-scheme: light dark; --back: #e8e8e8; --text: #1c1c1c; --line: #b0b0b0; }
@media (prefers-color-scheme: dark) {
:root { --back: #242424; --text: #dedede; --line: #555; } }
body { margin: 2rem; background: var(--back); color: var(--text); font: 15px/1.5 sans-serif; }
h1 { font-size: 1.3rem; overflow-wrap: anywhere; }
table { border-collapse: collapse; margin-bottom: 2rem; }
th, td { text-align: left; font-weight: normal; padding: 0.2rem 1.5rem 0.2rem 0;
 border-bottom: 1px solid var(--line); overflow-wrap: anywhere; }
td { font-variant-numeric: tabular-nums; }
main { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr));
 gap: 1.5rem; }
figure { margin: 0; }
img { width: 100%; height: auto; image-rendering: pixelated; }
</style>
)";

inline std::string html_figure(const HtmlFigure& figure, const std::filesystem::path& path) {
    const std::string caption = html_escaped(figure.caption);
    return "<figure><img alt=\"" + caption + "\" width=\"" +
           std::to_string(figure.picture->width()) + "\" height=\"" +
           std::to_string(figure.picture->height()) + "\" src=\"data:image/png;base64," +
           base64(png_bytes(figure, path)) + "\"><figcaption>" + caption +
           "</figcaption></figure>\n";
}

inline std::string html_page(const HtmlReport& report, const std::filesystem::path& path) {
    const std::string title = html_escaped(report.title);
    std::string page = html_head;
    page += "<title>" + title + "</title>\n</head>\n<body>\n<h1>" + title + "</h1>\n<table>\n";
    for (const auto& [label, value] : report.rows)
        page += "<tr><th scope=\"row\">" + html_escaped(label) + "</th><td>" + html_escaped(value) +
                "</td></tr>\n";
    page += "</table>\n<main>\n";
    for (const HtmlFigure& figure : report.figures) page += html_figure(figure, path);
    return page + "</main>\n</body>\n</html>\n";
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
    const std::string page = detail::html_page(report, path);
    AtomicFile target(path);
    errno = 0;
    std::ofstream stream(target.temporary(), std::ios::binary | std::ios::trunc);
    stream << page;
    stream.close();
    if (!stream)
        throw Error(ErrorCode::io, path.string() + ": the report cannot be written (" +
                                       std::strerror(errno != 0 ? errno : EIO) +
                                       "); free space there or choose another folder");
    target.commit();
}

}  // namespace mir
