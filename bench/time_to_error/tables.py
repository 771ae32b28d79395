# SPDX-License-Identifier: MIT
"""What was measured, as CSV and as Markdown."""
import csv
import dataclasses
import statistics

import curves

LEVELS = (0.1, 0.03, 0.01, 0.003, 0.001)


@dataclasses.dataclass(frozen=True)
class Row:
    """The error of one layer of one picture, and what the picture cost."""
    scene: str
    key: str  # of everything that the picture depends on
    width: int
    height: int
    layer: str
    configuration: str
    group: str
    value: int
    seed: int
    cpu_seconds: float
    wall_seconds: float
    megabytes: float
    relmse: float
    relmse_trimmed: float


FIELDS = [field.name for field in dataclasses.fields(Row)]


def read_rows(path):
    """Rows of an earlier run; none without the file."""
    if not path.exists():
        return []
    types = [field.type for field in dataclasses.fields(Row)]
    with open(path, newline="", encoding="utf-8") as file:
        return [Row(*(kind(line[name]) for name, kind in zip(FIELDS, types)))
                for line in csv.DictReader(file)]


def write_rows(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(FIELDS)
        writer.writerows(dataclasses.astuple(row) for row in rows)


def points_of(rows, metric, clock):
    """A point for each value: means over the seeds. `clock` is the field with the seconds."""
    values = {}
    for row in rows:
        values.setdefault(row.value, []).append(row)
    return [curves.Point(value, statistics.mean(getattr(r, clock) for r in same),
                         statistics.mean(getattr(r, metric) for r in same))
            for value, same in sorted(values.items())]


def curves_of(rows, metric, clock):
    """Points and group by configuration, of one scene and layer, in the order of the rows."""
    found = {}
    for row in rows:
        found.setdefault(row.configuration, []).append(row)
    return {name: (points_of(same, metric, clock), same[0].group) for name, same in found.items()}


def seconds_text(reached, longest):
    if reached is None:
        return f"not reached in {longest:.3g} s"
    return ("≤ " if reached.is_bound else "") + f"{reached.seconds:.3g}"


def marked_line(name, cells, slope):
    return f"| {name} | " + " | ".join(cells) + f" | {'' if slope is None else f'{slope:.2f}'} |"


def best_text(best):
    if best is None:
        return "not reached"
    reached, name = best
    return f"**{seconds_text(reached, 0)}** ({name})"


def best_of_groups(found, level, smallest):
    """The quickest configuration of each group that has several, by group."""
    best, sizes = {}, {}
    for name, (points, group) in found.items():
        sizes[group] = sizes.get(group, 0) + 1
        reached = curves.seconds_to(points, level, smallest)
        if reached and (group not in best or reached.seconds < best[group][0].seconds):
            best[group] = (reached, name)
    return {group: best.get(group) for group, size in sizes.items() if size > 1}


def cell_of(points, level, smallest):
    if level < smallest:
        return "not told"
    longest = max(p.seconds for p in points)
    return seconds_text(curves.seconds_to(points, level, smallest), longest)


def level_table(found, levels, smallest):
    """Seconds to each level, a row for each configuration and for the best of each group."""
    lines = ["| Configuration | " + " | ".join(f"{level:g}" for level in levels) + " | slope |",
             "|---|" + "---|" * (len(levels) + 1)]
    for name, (points, _) in found.items():
        cells = [cell_of(points, level, smallest) for level in levels]
        lines.append(marked_line(name, cells, curves.slope(points)))
    best = [best_of_groups(found, level, smallest) for level in levels]
    for group in best[0]:
        cells = ["not told" if level < smallest else best_text(b[group])
                 for level, b in zip(levels, best)]
        lines.append(marked_line(f"best of {group}", cells, None))
    return lines
