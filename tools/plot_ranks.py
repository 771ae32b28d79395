#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the model of growth of docs/decisions/063: seconds of a picture and bytes that ranks of MPI
send, against how many they are, a line for each picture. Axes are logarithmic. Reads a CSV of
measured parts, a row for each loop over bands, and writes one SVG; --table prints the numbers as
Markdown.
"""
import argparse
import csv
import math
import sys
from xml.sax.saxutils import escape

from plot_convergence import Scale, mark
from plot_micro_bias import GAP, HEIGHT, LEFT, LINES, TOP, WIDTH, draw_panel, style

RANKS = [1, 2, 4, 8, 16, 32, 64, 125, 250, 500, 1000]
BANDS_EACH = 8  # that src/runtime/shared_frame.cpp cuts for each rank
NEEDED = ("picture", "each_s", "shared_s", "turn_s", "turn_bytes", "bands", "pixel_bytes")


def read(name):
    """Loops by picture, in the order of the file."""
    pictures = {}
    with open(name, newline="", encoding="utf-8") as file:
        rows = csv.DictReader(file)
        missing = set(NEEDED) - set(rows.fieldnames or [])
        if missing:
            sys.exit(f"{name}: column '{sorted(missing)[0]}' is missing (it is no table of parts); "
                     "give docs/images/ranks.csv")
        for row in rows:
            pictures.setdefault(row["picture"], []).append(
                {key: float(row[key]) for key in NEEDED[1:]})
    if not pictures or len(pictures) > len(LINES):
        sys.exit(f"{name}: it holds {len(pictures)} pictures; give 1 to {len(LINES)}")
    return pictures


def bands_of(loop, ranks):
    return min(BANDS_EACH * ranks, loop["bands"])


def seconds(loops, ranks, rate, latency):
    """Of a picture by so many ranks of one core each."""
    total = 0.0
    for loop in loops:
        bands = bands_of(loop, ranks)
        total += loop["each_s"]
        if ranks == 1:
            total += loop["shared_s"] + loop["turn_s"]
            continue
        # The rank with most bands, or turns one behind the other. The first waits for its band.
        turn = loop["turn_s"] / bands + 2 * (latency + loop["turn_bytes"] / rate)
        by_work = loop["shared_s"] * math.ceil(bands / ranks) / bands
        total += max(by_work + turn, loop["shared_s"] / bands + bands * turn)
        total += loop["pixel_bytes"] / rate
    return total


def traffic(loops, ranks):
    """Bytes of all messages. Half of them pass rank 0 each way; its own are none."""
    others = (ranks - 1) / ranks
    return sum(others * (2 * bands_of(loop, ranks) * loop["turn_bytes"] + loop["pixel_bytes"])
               for loop in loops)


def draw(pictures, rate, latency):
    names = list(pictures)
    panels = [("ranks of one core: seconds",
               {name: {n: seconds(loops, n, rate, latency) for n in RANKS}
                for name, loops in pictures.items()}),
              ("ranks of one core: bytes sent, GB",
               {name: {n: traffic(loops, n) / 1e9 for n in RANKS[1:]}
                for name, loops in pictures.items()})]
    width, height = LEFT + 2 * (WIDTH + GAP) + 36, TOP + HEIGHT + 50
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
           f'width="{width}" height="{height}" role="img" '
           'aria-label="seconds and bytes against the number of ranks">',
           style(), f'<rect class="ground" width="{width}" height="{height}"/>']
    left = LEFT
    for i, name in enumerate(names):
        out.append(f'<g class="s{i}"><line class="line" x1="{left}" x2="{left + 26}" y1="18" '
                   f'y2="18"/>{mark(LINES[i][0], left + 13, 18)}</g>'
                   f'<text x="{left + 33}" y="22">{escape(name)}</text>')
        left += 52 + 7 * len(name)
    for i, (title, curves) in enumerate(panels):
        values = [v for curve in curves.values() for v in curve.values()]
        y = Scale(min(values) / 1.4, max(values) * 1.4, TOP + HEIGHT, TOP)
        draw_panel(out, title, curves, LEFT + i * (WIDTH + GAP + 24), y, names)
    return "\n".join(out + ["</svg>"]) + "\n"


def table(pictures, rate, latency):
    lines = ["| Picture | " + " | ".join(str(n) for n in RANKS) + " |",
             "|---|" + "---:|" * len(RANKS)]
    for name, loops in pictures.items():
        lines.append(f"| {name}, s | " + " | ".join(
            f"{seconds(loops, n, rate, latency):.3g}" for n in RANKS) + " |")
        lines.append(f"| {name}, GB | " + " | ".join(
            f"{traffic(loops, n) / 1e9:.3g}" for n in RANKS) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", help="CSV of parts")
    parser.add_argument("-o", "--output", help="SVG to write")
    parser.add_argument("--rate", type=float, default=1.25e9, help="bytes a second to or from rank 0")
    parser.add_argument("--latency", type=float, default=1e-3, help="seconds until one is heard")
    parser.add_argument("--table", action="store_true", help="print the numbers as Markdown")
    options = parser.parse_args()
    pictures = read(options.file)
    if options.output:
        with open(options.output, "w", encoding="utf-8") as file:
            file.write(draw(pictures, options.rate, options.latency))
    if options.table:
        print(table(pictures, options.rate, options.latency))


if __name__ == "__main__":
    main()
