// SPDX-License-Identifier: MIT
#include "report/log_chart.hpp"

#include "mir/io/html_text.hpp"
#include "text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mirtool {
namespace {

// Pixels of the SVG; the frame is where lines are.
constexpr double left = 64.0, right = 446.0, top = 12.0, bottom = 262.0;

/// Part of a logarithmic axis, in decades.
struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double value) {
        low = std::min(low, std::log10(value));
        high = std::max(high, std::log10(value));
    }
    /// Leaves room on both sides.
    void widen() {
        const double room = std::max(0.05, 0.06 * (high - low));
        low -= room;
        high += room;
    }
    [[nodiscard]] double share(double value) const {
        return (std::log10(value) - low) / (high - low);
    }
};

/// Where points lie in the picture.
struct Axes {
    Range x, y;

    [[nodiscard]] double across(double value) const {
        return left + (right - left) * x.share(value);
    }
    [[nodiscard]] double down(double value) const {
        return bottom - (bottom - top) * y.share(value);
    }
    [[nodiscard]] std::string place(LogSeries::Point p) const {
        return fixed(across(p.x), 1) + "," + fixed(down(p.y), 1);
    }
};

std::vector<LogSeries::Point> drawable(const LogSeries& series) {
    std::vector<LogSeries::Point> points;
    for (const LogSeries::Point p : series.points)
        if (p.x > 0.0 && p.y > 0.0 && std::isfinite(p.x) && std::isfinite(p.y)) points.push_back(p);
    return points;
}

/// Round numbers inside of a range. 1, 2 and 5 of each decade, or powers of ten of long ranges.
std::vector<double> ticks(const Range& range) {
    std::vector<double> values;
    const bool few = range.high - range.low > 2.5;
    for (double decade = std::floor(range.low); decade <= range.high; ++decade)
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * std::pow(10.0, decade);
            const double at = std::log10(value);
            if (at >= range.low && at <= range.high && (!few || digit == 1.0))
                values.push_back(value);
        }
    return values;
}

std::string line(double x1, double y1, double x2, double y2) {
    return "<line x1=\"" + fixed(x1, 1) + "\" y1=\"" + fixed(y1, 1) + "\" x2=\"" + fixed(x2, 1) +
           "\" y2=\"" + fixed(y2, 1) + "\"/>";
}

std::string text(double x, double y, const char* anchor, const std::string& words) {
    return "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" text-anchor=\"" + anchor +
           "\">" + words + "</text>";
}

std::string grid(const LogChart& chart, const Axes& axes) {
    std::string out = "<g class=\"grid\">";
    for (const double x : ticks(axes.x)) out += line(axes.across(x), top, axes.across(x), bottom);
    for (const double y : ticks(axes.y)) out += line(left, axes.down(y), right, axes.down(y));
    out += "</g>\n";
    for (const double x : ticks(axes.x))
        out += text(axes.across(x), bottom + 17, "middle", number(x));
    for (const double y : ticks(axes.y)) out += text(left - 6, axes.down(y) + 4, "end", number(y));
    return out + text(0.5 * (left + right), bottom + 36, "middle", chart.x_label) + "\n";
}

/// The part of the line of slope -1/2 through `p` inside the frame.
std::string half_slope(const Axes& axes, LogSeries::Point p) {
    const double x = std::log10(p.x);
    const double y = std::log10(p.y);
    const double begin = std::max(axes.x.low, x - 2.0 * (axes.y.high - y));
    const double end = std::min(axes.x.high, x + 2.0 * (y - axes.y.low));
    const auto at = [&](double where) {
        return LogSeries::Point{std::pow(10.0, where), std::pow(10.0, y - 0.5 * (where - x))};
    };
    const LogSeries::Point a = at(begin);
    const LogSeries::Point b = at(end);
    return "<g class=\"guide\">" +
           line(axes.across(a.x), axes.down(a.y), axes.across(b.x), axes.down(b.y)) + "</g>\n";
}

/// Series differ in shape as well as in colour.
std::string mark(bool square, double x, double y) {
    if (!square) return "<circle cx=\"" + fixed(x, 1) + "\" cy=\"" + fixed(y, 1) + R"(" r="3.5"/>)";
    return "<rect x=\"" + fixed(x - 3.5, 1) + "\" y=\"" + fixed(y - 3.5, 1) +
           R"(" width="7" height="7"/>)";
}

std::string class_of(std::size_t series) { return "s" + std::to_string(series + 1); }

std::string series_line(const Axes& axes, const std::vector<LogSeries::Point>& points,
                        std::size_t series) {
    std::string out = "<g class=\"" + class_of(series) + "\"><polyline points=\"";
    for (const LogSeries::Point p : points)
        out += (&p == &points.front() ? "" : " ") + axes.place(p);
    out += "\"/>";
    for (const LogSeries::Point p : points)
        out += mark(series > 0, axes.across(p.x), axes.down(p.y));
    return out + "</g>\n";
}

std::string legend(const LogChart& chart) {
    std::string list = "<ul class=\"legend\">\n";
    for (std::size_t i = 0; i < chart.series.size(); ++i)
        list +=
            R"(<li><svg class="swatch series" aria-hidden="true" viewBox="0 0 16 16"><g class=")" +
            class_of(i) + "\">" + mark(i > 0, 8, 8) + "</g></svg> " +
            mir::detail::html_escaped(chart.series[i].name) + "</li>\n";
    return list +
           R"(<li><svg class="swatch series" aria-hidden="true" viewBox="0 0 16 16">)"
           R"(<g class="guide"><line x1="0" y1="4" x2="16" y2="12"/></g></svg> slope −1/2</li>)"
           "\n</ul>\n";
}

}  // namespace

std::string log_chart(const LogChart& chart) {
    Axes axes;
    std::vector<std::vector<LogSeries::Point>> lines;
    std::size_t longest = 0;
    for (const LogSeries& series : chart.series) {
        lines.push_back(drawable(series));
        longest = std::max(longest, lines.back().size());
        for (const LogSeries::Point p : lines.back()) {
            axes.x.add(p.x);
            axes.y.add(p.y);
        }
    }
    if (longest < 2) return "";
    axes.x.widen();
    axes.y.widen();
    std::string svg = R"(<figure><svg class="series" role="img" aria-label=")" +
                      mir::detail::html_escaped(chart.title) +
                      "; the table below has the numbers\" viewBox=\"0 0 456 304\">\n" +
                      grid(chart, axes);
    if (!lines.front().empty()) svg += half_slope(axes, lines.front().back());
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (!lines[i].empty()) svg += series_line(axes, lines[i], i);
    return svg + "</svg>\n<figcaption>" + mir::detail::html_escaped(chart.y_label) +
           "</figcaption>\n" + legend(chart) + "</figure>\n";
}

}  // namespace mirtool
