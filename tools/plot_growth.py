#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what the program `bench_growth` measured: nanoseconds for a contribution against VPLs,
luxels and triangles, a row of panels for each machine and each way to ask, a line for each scene.
Axes are logarithmic. Reads its JSON (--benchmark_format=json), writes one SVG.
"""
import argparse
import json
import re
import sys
from xml.sax.saxutils import escape

from plot_convergence import Scale, mark
from plot_micro_bias import GAP, HEIGHT, LEFT, LINES, TOP, WIDTH, draw_panel, style

MACHINES = {"cuda": "GPU", "kdtree": "GPU, kd-tree", "cpu": "processor", "embree": "Embree"}
SWEEPS = {"vpls": "VPLs", "luxels": "luxels", "triangles": "triangles"}


def read(files):
    """Nanoseconds by machine, sweep, scene and place on the axis."""
    found = {}
    for name in files:
        with open(name, encoding="utf-8") as file:
            runs = json.load(file)["benchmarks"]
        for run in runs:
            match = re.match(r"growth/(\w+)/(.+)/(\w+):(\d+)/iterations", run["name"])
            if not match:
                sys.exit(f"{name}: '{run['name']}' is no picture of a sweep (it is no output of "
                         "bench_growth); give one that is")
            machine, scene, sweep, place = match.groups()
            if sweep not in SWEEPS or run.get("error_occurred"):
                continue
            x = run["triangles"] if sweep == "triangles" else int(place)
            curves = found.setdefault(machine, {}).setdefault(sweep, {})
            curves.setdefault(scene.removeprefix("builtin:"), {})[x] = run["ns_per_contribution"]
    if not found:
        sys.exit("the files hold no pictures (there is nothing to draw); run bench_growth first")
    return found


def draw_legend(out, scenes):
    left = LEFT
    for i, scene in enumerate(scenes):
        out.append(f'<g class="s{i}"><line class="line" x1="{left}" x2="{left + 26}" y1="18" '
                   f'y2="18"/>{mark(LINES[i][0], left + 13, 18)}</g>'
                   f'<text x="{left + 33}" y="22">{escape(scene)}</text>')
        left += 52 + 7 * len(scene)


def draw(found):
    scenes = list(dict.fromkeys(scene for sweeps in found.values() for curves in sweeps.values()
                                for scene in curves))
    if len(scenes) > len(LINES):
        sys.exit(f"{len(scenes)} scenes are too many to tell apart; give {len(LINES)} at most")
    row = HEIGHT + 64
    width = LEFT + len(SWEEPS) * (WIDTH + GAP) + 20
    height = TOP + len(found) * row
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
           f'width="{width}" height="{height}" role="img" '
           'aria-label="cost of a contribution against VPLs, luxels and triangles">',
           style(), f'<rect class="ground" width="{width}" height="{height}"/>']
    draw_legend(out, scenes)
    for r, (machine, sweeps) in enumerate(found.items()):
        values = [v for curves in sweeps.values() for curve in curves.values()
                  for v in curve.values()]
        top = TOP + r * row
        y = Scale(min(values) / 1.4, max(values) * 1.4, top + HEIGHT, top)
        for i, (sweep, title) in enumerate(SWEEPS.items()):
            if sweep in sweeps:
                draw_panel(out, title, sweeps[sweep], LEFT + i * (WIDTH + GAP), y, scenes)
        out.append(f'<text transform="translate(16 {top + HEIGHT / 2:.0f}) rotate(-90)" '
                   f'text-anchor="middle">ns, {MACHINES.get(machine, machine)}</text>')
    return "\n".join(out + ["</svg>"]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", help="JSON of the program bench_growth")
    parser.add_argument("-o", "--output", required=True, help="SVG to write")
    options = parser.parse_args()
    with open(options.output, "w", encoding="utf-8") as file:
        file.write(draw(read(options.files)))


if __name__ == "__main__":
    main()
