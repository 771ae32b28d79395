# SPDX-License-Identifier: MIT
"""Error against seconds as SVG: a panel for each scene and layer, both axes logarithmic."""
import pathlib
import sys
from xml.sax.saxutils import escape

import page
import tables

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
from plot_convergence import (DARK_STYLE, LIGHT_STYLE, Scale, decades, mark,  # noqa: E402
                              points)

# Of the groups, in the order in which they come: shape, colour on light and on dark ground.
STYLES = [("circle", "#0072b2", "#56b4e9"), ("square", "#d55e00", "#f0a04b"),
          ("triangle", "#009e73", "#35c79a"), ("diamond", "#b04f8f", "#e08cc4"),
          ("circle", "#6e6e6e", "#b0b0b0"), ("square", "#7a5c00", "#e0c05a"),
          ("triangle", "#8b0000", "#ff8080"), ("diamond", "#3b3b98", "#a0a0ff")]
COLUMNS, WIDTH, HEIGHT, LEFT, GAP_X, GAP_Y = 2, 340, 260, 66, 58, 56
LEGEND_LINE = 18
AXES = {"cpu_seconds": "CPU seconds", "wall_seconds": "seconds"}


def style(groups):
    def colours(column):
        return "\n".join(f".g{i} .line {{ stroke: {STYLES[i % len(STYLES)][column]} }} "
                         f".g{i} .mark {{ fill: {STYLES[i % len(STYLES)][column]} }}"
                         for i in range(len(groups)))
    return (f"<style>{LIGHT_STYLE}.line {{ stroke-width: 1.4 }}\n{colours(1)}\n"
            f"@media (prefers-color-scheme: dark) {{{DARK_STYLE}{colours(2)}\n}}</style>")


def draw_curve(out, group, name, places):
    """The name is shown where the pointer rests, since curves of a group look alike."""
    shape = STYLES[group % len(STYLES)][0]
    out.append(f'<g class="g{group}"><title>{escape(name)}</title>'
               f'<polyline class="line" points="{points(places)}"/>')
    out.extend(mark(shape, *place) for place in places)
    out.append("</g>")


def draw_axes(out, x, y):
    for value in decades(y.low, y.high):
        out.append(f'<line class="grid" x1="{x.begin}" x2="{x.end}" y1="{y(value):.1f}" '
                   f'y2="{y(value):.1f}"/><text x="{x.begin - 7}" y="{y(value) + 4:.1f}" '
                   f'text-anchor="end">{value:g}</text>')
    for value in decades(x.low, x.high):
        out.append(f'<line class="grid" x1="{x(value):.1f}" x2="{x(value):.1f}" y1="{y.begin}" '
                   f'y2="{y.end}"/><text x="{x(value):.1f}" y="{y.begin + 16}" '
                   f'text-anchor="middle">{value:g}</text>')


def draw_panel(out, title, found, groups, left, top):
    """`found`: points and group by configuration, of errors above 0 alone."""
    seconds = [p.seconds for curve, _ in found.values() for p in curve]
    errors = [p.error for curve, _ in found.values() for p in curve]
    x = Scale(min(seconds) / 1.2, max(seconds) * 1.2, left, left + WIDTH)
    y = Scale(min(errors) / 1.2, max(errors) * 1.2, top + HEIGHT, top)
    draw_axes(out, x, y)
    for name, (curve, group) in found.items():
        draw_curve(out, groups.index(group), name, [(x(p.seconds), y(p.error)) for p in curve])
    out.append(f'<rect class="frame" x="{left}" y="{top}" width="{WIDTH}" height="{HEIGHT}"/>'
               f'<text class="title" x="{left}" y="{top - 8}">{escape(title)}</text>')


def draw_legend(out, groups):
    for i, group in enumerate(groups):
        row = 20 + i * LEGEND_LINE
        out.append(f'<g class="g{i}"><line class="line" x1="{LEFT}" x2="{LEFT + 26}" y1="{row}" '
                   f'y2="{row}"/>{mark(STYLES[i % len(STYLES)][0], LEFT + 13, row)}</g>'
                   f'<text x="{LEFT + 34}" y="{row + 4}">{escape(group)}</text>')


def shown(rows, metric, clock):
    """Curves without the pictures whose error noise of the references hides."""
    found = {}
    for name, (curve, group) in tables.curves_of(rows, metric, clock).items():
        above = [p for p in curve if p.error > 0]
        if above:
            found[name] = (above, group)
    return found


def write(path, results, metric, clock):
    """`results`: rows and the references' own errors, by (scene, layer)."""
    panels = [(page.heading(*key), shown(rows, metric, clock)) for key, (rows, _) in results.items()]
    panels = [(title, found) for title, found in panels if found]
    groups = list(dict.fromkeys(g for _, found in panels for _, g in found.values()))
    head = 44 + len(groups) * LEGEND_LINE
    columns = min(COLUMNS, len(panels))
    lines = -(-len(panels) // COLUMNS)
    width = LEFT + columns * (WIDTH + GAP_X)
    height = head + lines * (HEIGHT + GAP_Y) + 14
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
           f'width="{width}" height="{height}" role="img" aria-label="error against time">',
           style(groups), f'<rect class="ground" width="{width}" height="{height}"/>']
    draw_legend(out, groups)
    for i, (title, found) in enumerate(panels):
        draw_panel(out, title, found, groups, LEFT + i % COLUMNS * (WIDTH + GAP_X),
                   head + i // COLUMNS * (HEIGHT + GAP_Y))
    out.append(f'<text x="{width / 2:.0f}" y="{height - 10}" text-anchor="middle">'
               f"{AXES[clock]}; upwards: scaled relMSE</text></svg>")
    path.write_text("\n".join(out) + "\n", encoding="utf-8")
