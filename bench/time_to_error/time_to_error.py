#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures which way to draw a picture has the least error after how many seconds.

Draws each scene by each configuration with more and more VPLs or paths, and compares every picture
with two references of the path tracer. Writes into a folder: measurements.csv, time_to_error.md
with the seconds to each level, time_to_error.svg, and references/, which a later run uses again.
A run that was stopped goes on where it was when it is started again with the same options and the
same program.
"""
import argparse
import pathlib
import shlex
import sys

import configurations
import job as jobs
import measure
import page
import plot
import references
import renderers
import tables

FIRST_SEED = 1
QUICK = {"scene": ["builtin:cornell-box"], "size": (24, 24), "reference_paths": 64, "seconds": 5.0}


def size(text):
    width, height = (int(side) for side in text.split("x"))
    return width, height


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="*", help="builtin:NAME or a file; default: cornell-box")
    parser.add_argument("--mir", default="mir", help="the program (default: mir)")
    parser.add_argument("-o", "--output", type=pathlib.Path,
                        default=pathlib.Path("out/time_to_error"),
                        help="folder (default: out/time_to_error)")
    parser.add_argument("--size", type=size, default=(240, 240), help="default: 240x240")
    parser.add_argument("--reference-paths", type=int, default=4096,
                        help="a pixel of each reference (default: 4096)")
    parser.add_argument("--seconds", type=float, default=30.0,
                        help="a curve ends at a picture of more seconds (default: 30)")
    parser.add_argument("--seeds", type=int, default=1,
                        help="pictures for each point (default: 1)")
    parser.add_argument("--only", action="append", default=[], metavar="TEXT",
                        help="the configurations whose name begins so; may be repeated")
    parser.add_argument("--add", action="append", default=[], metavar="NAME:VALUES:OPTIONS",
                        help="a further one, as 'cuts 32: 1024,4096: --sum cuts --picks 32 "
                             "--vpls {}'; those of a name up to its first comma are a group")
    parser.add_argument("--backend", default="cpu", help="of mir (default: cpu)")
    parser.add_argument("--options", default="", help="of every mir render")
    parser.add_argument("--environment", default="", metavar="OPTIONS",
                        help="--environment FILE and what belongs to it")
    parser.add_argument("--levels", default=",".join(f"{v:g}" for v in tables.LEVELS))
    parser.add_argument("--metric", choices=["relmse_trimmed", "relmse"], default="relmse_trimmed")
    parser.add_argument("--clock", choices=["cpu_seconds", "wall_seconds"], default="cpu_seconds",
                        help="what is compared (default: cpu_seconds); wall_seconds with a GPU")
    parser.add_argument("--list", action="store_true", help="print the configurations and end")
    parser.add_argument("--quick", action="store_true",
                        help="a tiny picture and two configurations, as a test")
    options = parser.parse_args()
    if options.quick:
        vars(options).update(QUICK)
    options.scene = options.scene or QUICK["scene"]
    return options


def chosen(options):
    """The configurations asked for."""
    usual = configurations.quick() if options.quick else configurations.standard()
    if options.only:
        usual = [c for c in usual if c.name.startswith(tuple(options.only))]
    try:
        usual += [configurations.parsed(text) for text in options.add]
    except ValueError as error:
        sys.exit(f"time_to_error: --add: {error}")
    if not usual:
        sys.exit(f"time_to_error: --only: no configuration begins with {options.only} (--list "
                 "prints them); give the beginning of one")
    return usual


class Study:
    """All rows so far, kept in the file after each picture."""

    def __init__(self, folder):
        self._file = folder / "measurements.csv"
        self._rows = tables.read_rows(self._file)

    def known(self, wanted):
        """The layers of a picture that was measured before."""
        return [row for row in self._rows
                if (row.key, row.configuration, row.value, row.seed) == wanted]

    def add(self, rows):
        self._rows += rows
        tables.write_rows(self._file, self._rows)


class SceneStudy:
    """Measures the pictures of one scene."""

    def __init__(self, study, job, options, missing):
        self._study, self._job, self._options = study, job, options
        self._references = references.References(job, options.output / "references",
                                                 options.reference_paths)
        self._renderers = renderers.Renderers(job, options.output, missing)
        self._picture = options.output / "picture.exr"  # one after the other

    def own_error(self, layer):
        found = self._references.own_error(jobs.LAYERS[layer])
        return found["trimmed" if self._options.metric == "relmse_trimmed" else "mean"]

    def curve(self, configuration):
        """Rows from the quickest picture to the first that is slow or as good as wanted."""
        self._renderers.check(configuration)
        rows = []
        values = configuration.values
        for value, following in zip(values, (*values[1:], None)):
            point = [row for i in range(self._options.seeds)
                     for row in self._picture_rows(configuration, value, FIRST_SEED + i)]
            rows += point
            if following and self._is_last(point, following / value):
                break
        return rows

    def _is_last(self, point, growth):
        """True when the next picture would be slow by far, or this one is good enough."""
        seconds = max(getattr(row, self._options.clock) for row in point)
        worst = max(getattr(row, self._options.metric) for row in point)
        limit = self._options.seconds
        return seconds > limit or seconds * growth > 3 * limit or worst < min(self._options.levels)

    def _picture_rows(self, configuration, value, seed):
        key = "|".join(str(word) for word in
                       (self._job.program, *self._job.key, *self._references.names(),
                        *configuration.options))
        wanted = (key, configuration.name, value, seed)
        known = self._study.known(wanted)
        if known:
            return known
        cost = self._renderers.draw(configuration, value, seed, self._picture)
        rows = [self._row(wanted, configuration, cost, layer)
                for layer in self._renderers.layers(configuration)]
        self._study.add(rows)
        print(f"{self._job.name}: {configuration.name}, {value}: {cost.cpu:.2f} s, " +
              ", ".join(f"{r.layer} {r.relmse_trimmed:.3g}" for r in rows), flush=True)
        return rows

    def _row(self, wanted, configuration, cost, layer):
        key, name, value, seed = wanted
        error = self._references.error_of(self._picture, jobs.LAYERS[layer])
        return tables.Row(self._job.scene, key, self._job.width, self._job.height, layer, name,
                          configuration.group, value, seed, round(cost.cpu, 4),
                          round(cost.wall, 4), round(cost.megabytes, 1), error["mean"],
                          error["trimmed"])


def measure_scene(scene, wanted):
    """Rows of all configurations, and what was left out."""
    rows, left_out = [], []
    for configuration in wanted:
        try:
            rows += scene.curve(configuration)
        except (renderers.LeftOut, measure.Failed) as reason:
            left_out.append((configuration.name, str(reason)))
            print(f"left out: {configuration.name}: {reason}", flush=True)
    return rows, left_out


def main():
    options = arguments()
    wanted = chosen(options)
    if options.list:
        print("\n".join(f"{c.name}: {','.join(map(str, c.values))}: {shlex.join(c.options)}"
                        for c in wanted))
        return
    options.levels = [float(level) for level in options.levels.split(",")]
    options.output.mkdir(parents=True, exist_ok=True)
    needs_more = any(c.program == "mitsuba" for c in wanted)
    missing = renderers.missing_programs() if needs_more else {}
    study = Study(options.output)
    results, left_out = {}, []
    for name in options.scene:
        job = jobs.make_job(options.mir, name, options.size, options.backend,
                            shlex.split(options.options), shlex.split(options.environment))
        scene = SceneStudy(study, job, options, missing)
        rows, absent = measure_scene(scene, wanted)
        left_out += [(name, *one) for one in absent]
        for layer in jobs.LAYERS:
            of_layer = [row for row in rows if row.layer == layer]
            if of_layer:
                results[name, layer] = (of_layer, scene.own_error(layer))
        page.write(options.output / "time_to_error.md", results, left_out, options.metric,
                   options.clock, options.levels)
        plot.write(options.output / "time_to_error.svg", results, options.metric, options.clock)
    print(options.output / "time_to_error.md")


if __name__ == "__main__":
    try:
        main()
    except measure.Failed as failure:
        sys.exit(f"time_to_error: {failure}")
