#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what the program `convergence` printed: error against the number of VPLs, a panel for each
scene, a line for each sampler (mean over seeds) in a band from the best to the worst seed. Both
axes are logarithmic. Reads CSV files, writes one SVG; --table prints the numbers as Markdown.
"""
import argparse
import csv
import math
import statistics
import sys
from xml.sax.saxutils import escape

# Name, shape of the marks, colour on light and on dark ground. Colours of Okabe and Ito, told apart
# with any colour vision and brighter on dark ground; shapes say the same once more.
SAMPLERS = {
    "ir": ("instant radiosity", "square", "#d55e00", "#f0a04b"),
    "bir": ("bidirectional", "triangle", "#009e73", "#35c79a"),
    "mir": ("Metropolis", "circle", "#0072b2", "#56b4e9"),
}
LIGHT_STYLE = """
.ground { fill: #ffffff } .frame { fill: none; stroke: #8c8c8c }
.grid { stroke: #d9d9d9; stroke-width: 0.7 }
.guide { stroke: #6e6e6e; stroke-width: 1.2; stroke-dasharray: 5 4; fill: none }
text { fill: #1a1a1a; font: 12px sans-serif } .title { font-weight: bold; font-size: 13px }
.line { fill: none; stroke-width: 2 } .band { fill-opacity: 0.18; stroke: none }
"""
DARK_STYLE = """
.ground { fill: #0d1117 } text { fill: #e6e6e6 } .grid { stroke: #30363d }
.frame { stroke: #7d7d7d } .guide { stroke: #a0a0a0 } .band { fill-opacity: 0.25 }
"""
COLUMNS, PANEL_WIDTH, PANEL_HEIGHT = 3, 210, 190
LEFT, TOP, GAP_X, GAP_Y, BOTTOM = 62, 58, 28, 46, 48


def read(files, metric):
    """Errors of the seeds, by scene, sampler and number of VPLs, in the order of the files."""
    errors = {}
    for name in files:
        with open(name, newline="", encoding="utf-8") as file:
            rows = csv.DictReader(file)
            missing = {"scene", "sampler", "vpls", metric} - set(rows.fieldnames or [])
            if missing:
                sys.exit(f"{name}: column '{sorted(missing)[0]}' is missing (it is no table of "
                         "the program convergence); give one that is")
            for row in rows:
                if row["sampler"] not in SAMPLERS:
                    sys.exit(f"{name}: sampler '{row['sampler']}' is unknown (it has no colour); "
                             f"give renders of {', '.join(SAMPLERS)}")
                scene = errors.setdefault(row["scene"], {})
                counts = scene.setdefault(row["sampler"], {})
                counts.setdefault(int(row["vpls"]), []).append(float(row[metric]))
    if not errors:
        sys.exit("the files hold no renders (there is nothing to draw); run convergence first")
    return errors


def decades(low, high):
    """1, 2 and 5 times the powers of ten between two numbers."""
    exponents = range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 1)
    return [m * 10.0**e for e in exponents for m in (1, 2, 5)
            if low <= m * 10.0**e * 1.000001 and m * 10.0**e <= high * 1.000001]


class Scale:
    """Logarithmic map from [low, high] to [begin, end] pixels."""

    def __init__(self, low, high, begin, end):
        self.low, self.high, self.begin, self.end = low, high, begin, end

    def __call__(self, value):
        t = math.log(value / self.low) / math.log(self.high / self.low)
        return self.begin + t * (self.end - self.begin)

    def clamped(self, value):
        return self(min(max(value, self.low), self.high))


def points(pairs):
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in pairs)


def style():
    def colours(column):
        return "\n".join(f".{key} .line {{ stroke: {of[column]} }} "
                         f".{key} .band, .{key} .mark {{ fill: {of[column]} }}"
                         for key, of in SAMPLERS.items())
    return (f"<style>{LIGHT_STYLE}{colours(2)}\n@media (prefers-color-scheme: dark) {{"
            f"{DARK_STYLE}{colours(3)}\n}}</style>")


def mark(shape, x, y):
    if shape == "circle":
        return f'<circle class="mark" cx="{x:.1f}" cy="{y:.1f}" r="4"/>'
    if shape == "square":
        return f'<rect class="mark" x="{x - 3.7:.1f}" y="{y - 3.7:.1f}" width="7.4" height="7.4"/>'
    corners = [(x, y - 5), (x - 4.7, y + 3.7), (x + 4.7, y + 3.7)]
    if shape == "diamond":
        corners = [(x, y - 5.2), (x - 5.2, y), (x, y + 5.2), (x + 5.2, y)]
    return f'<polygon class="mark" points="{points(corners)}"/>'


def draw_curve(out, sampler, counts, x, y):
    numbers = sorted(counts)
    lower = [(x(n), y.clamped(min(counts[n]))) for n in numbers]
    upper = [(x(n), y.clamped(max(counts[n]))) for n in reversed(numbers)]
    means = [(x(n), y.clamped(statistics.mean(counts[n]))) for n in numbers]
    out.append(f'<g class="{sampler}"><polygon class="band" points="{points(lower + upper)}"/>'
               f'<polyline class="line" points="{points(means)}"/>')
    out.extend(mark(SAMPLERS[sampler][1], *place) for place in means)
    out.append("</g>")


def draw_guide(out, x, y):
    """A line of slope -1/2 through the middle of the panel's right edge."""
    fall = math.sqrt(x.high / x.low)
    end = math.exp(0.75 * math.log(y.low) + 0.25 * math.log(y.high))
    begin, left = end * fall, x.low
    if begin > y.high:
        left, begin = x.low * (begin / y.high) ** 2, y.high
    line = [(x(left), y(begin)), (x(x.high), y(end))]
    out.append(f'<polyline class="guide" points="{points(line)}"/>')


def draw_panel(out, scene, samplers, x, y, labels_y):
    for value in decades(y.low, y.high):
        out.append(f'<line class="grid" x1="{x.begin}" x2="{x.end}" y1="{y(value):.1f}" '
                   f'y2="{y(value):.1f}"/>')
        if labels_y:
            out.append(f'<text x="{x.begin - 7}" y="{y(value) + 4:.1f}" '
                       f'text-anchor="end">{value:g}</text>')
    for n in sorted({n for counts in samplers.values() for n in counts}):
        out.append(f'<line class="grid" x1="{x(n):.1f}" x2="{x(n):.1f}" y1="{y.begin}" '
                   f'y2="{y.end}"/><text x="{x(n):.1f}" y="{y.begin + 16}" '
                   f'text-anchor="middle">{n}</text>')
    draw_guide(out, x, y)
    for sampler, counts in samplers.items():
        draw_curve(out, sampler, counts, x, y)
    out.append(f'<rect class="frame" x="{x.begin}" y="{y.end}" width="{x.end - x.begin}" '
               f'height="{y.begin - y.end}"/>'
               f'<text class="title" x="{x.begin}" y="{y.end - 7}">{escape(scene)}</text>')


def draw_legend(out, samplers):
    left = LEFT
    for sampler in samplers:
        name, shape = SAMPLERS[sampler][:2]
        out.append(f'<g class="{sampler}"><line class="line" x1="{left}" x2="{left + 26}" y1="18" '
                   f'y2="18"/>{mark(shape, left + 13, 18)}</g>'
                   f'<text x="{left + 33}" y="22">{name}</text>')
        left += 52 + 7 * len(name)
    out.append(f'<line class="guide" x1="{left}" x2="{left + 26}" y1="18" y2="18"/>'
               f'<text x="{left + 33}" y="22">slope −1/2</text>')


def draw(errors, label):
    values = [e for scene in errors.values() for counts in scene.values()
              for seeds in counts.values() for e in seeds if e > 0]
    numbers = [n for scene in errors.values() for counts in scene.values() for n in counts]
    low, high = min(values) / 1.15, max(values) * 1.15
    columns = min(COLUMNS, len(errors))
    rows = math.ceil(len(errors) / columns)
    width = LEFT + columns * PANEL_WIDTH + (columns - 1) * GAP_X + 16
    height = TOP + rows * PANEL_HEIGHT + (rows - 1) * GAP_Y + BOTTOM
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
           f'width="{width}" height="{height}" role="img" aria-label="{label} against VPLs">',
           style(),
           f'<rect class="ground" width="{width}" height="{height}"/>']
    draw_legend(out, list(dict.fromkeys(s for scene in errors.values() for s in scene)))
    for i, (scene, samplers) in enumerate(errors.items()):
        left = LEFT + i % columns * (PANEL_WIDTH + GAP_X)
        top = TOP + i // columns * (PANEL_HEIGHT + GAP_Y)
        x = Scale(min(numbers) / 1.3, max(numbers) * 1.3, left, left + PANEL_WIDTH)
        y = Scale(low, high, top + PANEL_HEIGHT, top)
        draw_panel(out, scene, samplers, x, y, labels_y=i % columns == 0)
    middle = (LEFT + width) / 2
    out.append(f'<text x="{middle:.0f}" y="{height - 10}" text-anchor="middle">number of VPLs'
               "</text>")
    middle = (TOP + height - BOTTOM) / 2
    out.append(f'<text transform="translate(16 {middle:.0f}) rotate(-90)" text-anchor="middle">'
               f"{label}</text></svg>")
    return "\n".join(out) + "\n"


def table(errors):
    """Mean over seeds and its standard error; then how many times lower Metropolis is."""
    lines = ["| Scene | VPLs | " + " | ".join(name for name, *_ in SAMPLERS.values()) +
             " | instant radiosity / Metropolis |", "|---|---|" + "---|" * (len(SAMPLERS) + 1)]
    for scene, samplers in errors.items():
        for n in sorted({n for counts in samplers.values() for n in counts}):
            cells, means = [], {}
            for sampler in SAMPLERS:
                seeds = samplers.get(sampler, {}).get(n, [])
                if not seeds:
                    cells.append("")
                    continue
                means[sampler] = statistics.mean(seeds)
                cells.append(f"{means[sampler]:.3f}" if len(seeds) < 2 else
                             f"{means[sampler]:.3f} ± "
                             f"{statistics.stdev(seeds) / math.sqrt(len(seeds)):.3f}")
            ratio = means["ir"] / means["mir"] if {"ir", "mir"} <= means.keys() else None
            cells.append("" if ratio is None else f"{ratio:.1f}")
            lines.append(f"| {scene} | {n} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", help="CSV of the program convergence")
    parser.add_argument("-o", "--output", help="SVG to write")
    parser.add_argument("--metric", choices=["relative_rmse", "rmse"], default="relative_rmse")
    parser.add_argument("--table", action="store_true", help="print the numbers as Markdown")
    options = parser.parse_args()
    errors = read(options.files, options.metric)
    labels = {"relative_rmse": "RMSE of indirect light / its mean",
              "rmse": "RMSE of indirect light, W m⁻² sr⁻¹"}
    if options.output:
        with open(options.output, "w", encoding="utf-8") as file:
            file.write(draw(errors, labels[options.metric]))
    if options.table:
        print(table(errors))


if __name__ == "__main__":
    main()
