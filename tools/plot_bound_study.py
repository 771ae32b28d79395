#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what the program `bound_study` printed: bias (above) and noise (below) of the indirect
light against the number of VPLs, a column of panels for each scene, a line for each way to treat
what is near a VPL. Both axes are logarithmic. Reads CSV files, writes one SVG.
"""
import argparse
import csv
import sys
from xml.sax.saxutils import escape

from plot_convergence import DARK_STYLE, LIGHT_STYLE, Scale, decades, mark, points

# Colours of Okabe and Ito on light and on dark ground, and marks of plot_convergence.mark().
LINES = {
    "bounded": ("square", "#d55e00", "#f0a04b"),
    "compensate 4": ("triangle", "#009e73", "#35c79a"),
    "spheres 1.00": ("circle", "#0072b2", "#56b4e9"),
    "lobes from 0.30": ("circle", "#cc79a7", "#e3a3c6"),
    "lobes from 0.60": ("triangle", "#b8860b", "#f0e442"),
    "unbounded": ("square", "#6e6e6e", "#a8a8a8"),
}
NAMES = {"bounded": "points under a bound", "compensate 4": "--compensate 4",
         "spheres 1.00": "--vsl", "lobes from 0.30": "--glossy from 0.3",
         "lobes from 0.60": "--glossy from 0.6", "unbounded": "points without bound"}
ROWS = ("bias", "noise")
LEFT, TOP, WIDTH, HEIGHT, GAP_X, GAP_Y = 62, 62, 250, 190, 26, 40
LEAST = 0.003  # a bias below is drawn at the edge: the noise of the renders hides it


def read(files):
    """Bias and noise by panel, treatment and number of VPLs."""
    panels = {}
    for name in files:
        with open(name, newline="", encoding="utf-8") as file:
            rows = csv.DictReader(file)
            missing = {"scene", "roughness", "treatment", "vpls", *ROWS} - set(rows.fieldnames or [])
            if missing:
                sys.exit(f"{name}: column '{sorted(missing)[0]}' is missing (it is no table of "
                         "the program bound_study); give one that is")
            for row in rows:
                if row["treatment"] not in LINES:
                    continue
                gloss = f", roughness {float(row['roughness']):g}" if row["roughness"] else ""
                panel = panels.setdefault(row["scene"] + gloss, {})
                panel.setdefault(row["treatment"], {})[int(row["vpls"])] = {
                    key: float(row[key]) for key in ROWS}
    if not panels:
        sys.exit("the files hold no rows to draw; run bound_study first")
    return panels


def style():
    def colours(column):
        return "\n".join(f".l{i} .line {{ stroke: {of[column]} }} .l{i} .mark {{ fill: {of[column]} }}"
                         for i, of in enumerate(LINES.values()))
    return (f"<style>{LIGHT_STYLE}{colours(1)}\n@media (prefers-color-scheme: dark) {{"
            f"{DARK_STYLE}{colours(2)}\n}}</style>")


def draw_panel(out, title, key, panel, x, y, labels_y, labels_x):
    for value in decades(y.low, y.high):
        out.append(f'<line class="grid" x1="{x.begin}" x2="{x.end}" y1="{y(value):.1f}" '
                   f'y2="{y(value):.1f}"/>')
        if labels_y:
            out.append(f'<text x="{x.begin - 7}" y="{y(value) + 4:.1f}" '
                       f'text-anchor="end">{value:g}</text>')
    for n in sorted({n for counts in panel.values() for n in counts}):
        out.append(f'<line class="grid" x1="{x(n):.1f}" x2="{x(n):.1f}" y1="{y.begin}" '
                   f'y2="{y.end}"/>')
        if labels_x:
            out.append(f'<text x="{x(n):.1f}" y="{y.begin + 16}" text-anchor="middle">{n}</text>')
    for i, treatment in enumerate(LINES):
        counts = panel.get(treatment, {})
        places = [(x(n), y.clamped(counts[n][key])) for n in sorted(counts)]
        out.append(f'<g class="l{i}"><polyline class="line" points="{points(places)}"/>')
        out.extend(mark(LINES[treatment][0], *place) for place in places)
        out.append("</g>")
    out.append(f'<rect class="frame" x="{x.begin}" y="{y.end}" width="{x.end - x.begin}" '
               f'height="{y.begin - y.end}"/>'
               f'<text class="title" x="{x.begin}" y="{y.end - 7}">{escape(title)}</text>')


def draw_legend(out, panels):
    left = LEFT
    for i, treatment in enumerate(LINES):
        if not any(treatment in panel for panel in panels.values()):
            continue
        out.append(f'<g class="l{i}"><line class="line" x1="{left}" x2="{left + 26}" y1="18" '
                   f'y2="18"/>{mark(LINES[treatment][0], left + 13, 18)}</g>'
                   f'<text x="{left + 33}" y="22">{NAMES[treatment]}</text>')
        left += 50 + 7 * len(NAMES[treatment])
    return left


def draw(panels):
    numbers = [n for panel in panels.values() for counts in panel.values() for n in counts]
    values = [v[key] for panel in panels.values() for counts in panel.values()
              for v in counts.values() for key in ROWS]
    height = TOP + 2 * HEIGHT + GAP_Y + 48
    out = []
    width = max(draw_legend(out, panels),
                LEFT + len(panels) * WIDTH + (len(panels) - 1) * GAP_X + 16)
    for column, (name, panel) in enumerate(panels.items()):
        left = LEFT + column * (WIDTH + GAP_X)
        x = Scale(min(numbers) / 1.3, max(numbers) * 1.3, left, left + WIDTH)
        for row, key in enumerate(ROWS):
            top = TOP + row * (HEIGHT + GAP_Y)
            y = Scale(LEAST, max(values) * 1.2, top + HEIGHT, top)
            draw_panel(out, f"{key}: {name}", key, panel, x, y, column == 0, row == 1)
    middle = (LEFT + width) / 2
    out.append(f'<text x="{middle:.0f}" y="{height - 10}" text-anchor="middle">number of VPLs'
               "</text>")
    out.append(f'<text transform="translate(16 {TOP + HEIGHT:.0f}) rotate(-90)" '
               'text-anchor="middle">share of the mean indirect light</text></svg>')
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
                      f'width="{width}" height="{height}" role="img" '
                      'aria-label="bias and noise of indirect light against VPLs">', style(),
                      f'<rect class="ground" width="{width}" height="{height}"/>', *out]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", help="CSV of the program bound_study")
    parser.add_argument("-o", "--output", required=True, help="SVG to write")
    options = parser.parse_args()
    with open(options.output, "w", encoding="utf-8") as file:
        file.write(draw(read(options.files)))


if __name__ == "__main__":
    main()
