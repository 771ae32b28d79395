#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what the program `micro_bias` printed: error of tiles (root mean square) of a gathered
bounce, a panel against the threshold and one against the solid angle of a ray, a line for each
scene. Both axes are logarithmic. Reads CSV files, writes one SVG; --table prints the numbers as
Markdown.
"""
import argparse
import csv
import math
import sys
from xml.sax.saxutils import escape

from plot_convergence import DARK_STYLE, LIGHT_STYLE, Scale, decades, mark, points

# Colours of Okabe and Ito on light and on dark ground, and marks known to plot_convergence.mark().
LINES = [("square", "#d55e00", "#f0a04b"), ("circle", "#0072b2", "#56b4e9"),
         ("triangle", "#009e73", "#35c79a"), ("diamond", "#a0467a", "#dd8fbd")]
NEEDED = {"scene", "discs", "extent", "rays", "shape", "threshold", "bounce", "mean", "rms", "worst"}
LEFT, TOP, WIDTH, HEIGHT, GAP = 62, 58, 290, 220, 34


def read(files, bounce):
    """Rows of one bounce."""
    rows = []
    for name in files:
        with open(name, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            missing = NEEDED - set(reader.fieldnames or [])
            if missing:
                sys.exit(f"{name}: column '{sorted(missing)[0]}' is missing (it is no table of "
                         "the program micro_bias); give one that is")
            rows += [row for row in reader if int(row["bounce"]) == bounce]
    if not rows:
        sys.exit("the files hold no such bounce (there is nothing to draw); run micro_bias first")
    return rows


def curves(rows, x_of, wanted):
    """Error against x_of(row), by scene, with the largest number of discs."""
    most = {}
    for row in rows:
        most[row["scene"]] = max(most.get(row["scene"], 0), int(row["discs"]))
    found = {}
    for row in rows:
        if (row["extent"] == "piece" and row["shape"] == "disc" and wanted(row)
                and int(row["discs"]) == most[row["scene"]]):
            found.setdefault(row["scene"], {})[x_of(row)] = float(row["rms"])
    return found


def style():
    def colours(column):
        return "\n".join(f".s{i} .line {{ stroke: {of[column]} }} .s{i} .mark "
                         f"{{ fill: {of[column]} }}" for i, of in enumerate(LINES))
    return (f"<style>{LIGHT_STYLE}{colours(1)}\n@media (prefers-color-scheme: dark) {{"
            f"{DARK_STYLE}{colours(2)}\n}}</style>")


def number(value):
    """As a label: large numbers in whole ones, millions short."""
    if value >= 1e6:
        return f"{value / 1e6:.2g} M"
    return f"{value:,.0f}".replace(",", "\u2009") if value >= 100 else f"{value:.2g}"


def draw_panel(out, title, found, left, y, scenes):
    xs = sorted({x for curve in found.values() for x in curve})
    x = Scale(xs[0] / 1.4, xs[-1] * 1.4, left, left + WIDTH)
    for value in decades(y.low, y.high):
        out.append(f'<line class="grid" x1="{x.begin}" x2="{x.end}" y1="{y(value):.1f}" '
                   f'y2="{y(value):.1f}"/><text x="{x.begin - 6}" y="{y(value) + 4:.1f}" '
                   f'text-anchor="end">{value:g}</text>')
    for value in xs:
        out.append(f'<line class="grid" x1="{x(value):.1f}" x2="{x(value):.1f}" y1="{y.begin}" '
                   f'y2="{y.end}"/><text x="{x(value):.1f}" y="{y.begin + 16}" '
                   f'text-anchor="middle">{number(value)}</text>')
    for scene, curve in found.items():
        line = [(x(v), y(curve[v])) for v in sorted(curve)]
        i = scenes.index(scene)
        out.append(f'<g class="s{i}"><polyline class="line" points="{points(line)}"/>')
        out.extend(mark(LINES[i][0], *place) for place in line)
        out.append("</g>")
    out.append(f'<rect class="frame" x="{x.begin}" y="{y.end}" width="{WIDTH}" '
               f'height="{HEIGHT}"/><text x="{(x.begin + x.end) / 2:.0f}" y="{y.begin + 36}" '
               f'text-anchor="middle">{title}</text>')


def draw(rows, bounce):
    scenes = list(dict.fromkeys(row["scene"] for row in rows))[:len(LINES)]
    # At 256 rays against the threshold; at a threshold of 1 against a ray's solid angle overhead.
    panels = [("threshold, 256 rays",
               curves(rows, lambda row: float(row["threshold"]),
                      lambda row: row["rays"] == "256" and float(row["threshold"]) > 0)),
              ("solid angle of a ray at the zenith (sr), threshold 1",
               curves(rows, lambda row: math.pi / int(row["rays"]),
                      lambda row: float(row["threshold"]) == 1))]
    values = [v for _, found in panels for curve in found.values() for v in curve.values()]
    y = Scale(min(values) / 1.2, max(values) * 1.2, TOP + HEIGHT, TOP)
    width, height = LEFT + 2 * WIDTH + GAP + 20, TOP + HEIGHT + 50
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
           f'width="{width}" height="{height}" role="img" aria-label="error against threshold">',
           style(), f'<rect class="ground" width="{width}" height="{height}"/>']
    left = LEFT
    for i, scene in enumerate(scenes):
        out.append(f'<g class="s{i}"><line class="line" x1="{left}" x2="{left + 26}" y1="18" '
                   f'y2="18"/>{mark(LINES[i][0], left + 13, 18)}</g>'
                   f'<text x="{left + 33}" y="22">{escape(scene)}</text>')
        left += 52 + 7 * len(scene)
    for i, (title, found) in enumerate(panels):
        draw_panel(out, title, found, LEFT + i * (WIDTH + GAP), y, scenes)
    middle = TOP + HEIGHT / 2
    out.append(f'<text transform="translate(16 {middle:.0f}) rotate(-90)" text-anchor="middle">'
               f"error of tiles of D{bounce} (% of its mean)</text></svg>")
    return "\n".join(out) + "\n"


def table(rows):
    lines = ["| Scene | discs | extent | rays | where rays stop | threshold | mean | rms | worst |",
             "|---|---:|---|---:|---|---:|---:|---:|---:|"]
    for row in rows:
        errors = (f"{float(row[k]):.1f}".replace("-", "−") for k in ("mean", "rms", "worst"))
        shape = row["shape"] if float(row["threshold"]) > 0 else ""
        lines.append(f"| {row['scene']} | {row['discs']} | `{row['extent']}` | {row['rays']} | "
                     f"{shape} | {row['threshold']} | " + " | ".join(errors) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", help="CSV of the program micro_bias")
    parser.add_argument("-o", "--output", help="SVG to write")
    parser.add_argument("--bounce", type=int, default=2)
    parser.add_argument("--table", action="store_true", help="print the numbers as Markdown")
    options = parser.parse_args()
    rows = read(options.files, options.bounce)
    if options.output:
        with open(options.output, "w", encoding="utf-8") as file:
            file.write(draw(rows, options.bounce))
    if options.table:
        print(table(rows))


if __name__ == "__main__":
    main()
