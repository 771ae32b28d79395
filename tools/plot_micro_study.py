#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what the program `micro_study` printed: how many times as fast the hierarchy and approximate
rays are, against the number of discs, and the error of 64 luxels together, against the directions
of each. Axes are logarithmic. Reads one CSV file, writes one SVG.
"""
import argparse
import csv
import re
import sys
from xml.sax.saxutils import escape

from plot_convergence import Scale, mark
from plot_micro_bias import GAP, HEIGHT, LEFT, LINES, TOP, WIDTH, draw_panel, style

# Of each panel: its axes, and by line the pattern of `what` and what x is: its first group squared,
# as it is, or the number of discs.
PANELS = [
    ("discs", "times as fast", [
        ("hierarchy over every disc", r"brute force / hierarchy", None),
        ("approximate over exact, 16 rays", r"exact / approximate at 16 rays", None),
        ("approximate over exact, 256 rays", r"exact / approximate at 256 rays", None)]),
    ("directions of a luxel", "error of 64 luxels together (%)", [
        ("exact rays", r"rms error \(%\) of 64 luxels with (\d+) exact rays", 1),
        ("approximate rays", r"rms error \(%\) of 64 luxels with (\d+) approximate rays", 1),
        ("micro-buffers", r"rms error \(%\) of 64 luxels with buffers of side (\d+)", 2)]),
]


def curves(rows, lines):
    """Points of each line of a panel, by its name."""
    found = {}
    for name, pattern, power in lines:
        for row in rows:
            match = re.fullmatch(pattern, row["what"])
            if match:
                x = int(match.group(1)) ** power if power else int(row["discs"])
                found.setdefault(name, {})[x] = float(row["value"])
        if name not in found:
            sys.exit(f"the file has no rows of '{name}' (it is no table of the program "
                     "micro_study); give one that is")
    return found


def draw(rows):
    width, height = 2 * (LEFT + WIDTH) + GAP + 20, TOP + HEIGHT + 90
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
           f'width="{width}" height="{height}" role="img" aria-label="what each part brings">',
           style(), f'<rect class="ground" width="{width}" height="{height}"/>']
    top = TOP + 40
    for i, (x_title, y_title, lines) in enumerate(PANELS):
        left = LEFT + i * (LEFT + WIDTH + GAP)
        found = curves(rows, lines)
        values = [v for curve in found.values() for v in curve.values()]
        y = Scale(min(values) / 1.3, max(values) * 1.3, top + HEIGHT, top)
        for k, name in enumerate(found):
            out.append(f'<g class="s{k}"><line class="line" x1="{left}" x2="{left + 26}" '
                       f'y1="{18 + 22 * k}" y2="{18 + 22 * k}"/>'
                       f'{mark(LINES[k][0], left + 13, 18 + 22 * k)}</g>'
                       f'<text x="{left + 33}" y="{22 + 22 * k}">{escape(name)}</text>')
        draw_panel(out, x_title, found, left, y, list(found))
        out.append(f'<text transform="translate({left - 44} {top + HEIGHT / 2:.0f}) rotate(-90)" '
                   f'text-anchor="middle">{y_title}</text>')
    return "\n".join(out + ["</svg>"]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", help="CSV of the program micro_study")
    parser.add_argument("-o", "--output", required=True, help="SVG to write")
    options = parser.parse_args()
    with open(options.file, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    with open(options.output, "w", encoding="utf-8") as file:
        file.write(draw(rows))


if __name__ == "__main__":
    main()
