#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds every integrator against the reference path tracer, layer by layer, in scenes of files.

    tools/compare_integrators.py FILE...            files that `mir render` reads, builtin:NAME
    tools/compare_integrators.py --built-in         every built-in scene
    tools/compare_integrators.py FILE... --options "--sun=1,2,1 --ground"

Each scene is rendered small, some times with other seeds, by the path tracer, by VPLs of the
samplers mir, ir and bir, and by micro. Compared are the mean luminances of emission, direct and
indirect light, which `mir render --json` prints: no picture has to be read. Prints Markdown, a row
for each scene with the layer of largest |z| of each integrator; --rows prints every layer.

VPLs lack the light that their bound removes and that their largest number of reflections cuts. A
render reports both as shares, and they are added to its indirect light, as
tests/images/layers_test.cpp does. So the picture that people get is judged together with what it
says of itself. --compensate N has the program trace back what the bound removed; only what is cut
is added then. That is unbiased by itself, noisier, and tells of a scene that stands out whether the
share is to blame. Light that chains drop (dropped_share) and light that glossy surfaces send out in
the wrong shape (non_lambertian_share) are not corrected; the CSV has both shares.

Renders of one seed have the same luxels. So the difference of two integrators is taken seed by seed
and judged by Student's t; z is the normal deviate of the same probability, at most 8. The standard
error of the mean difference is at least what the renders report of their shares, and a millionth of
the mean, for rounding. Needs Python 3 alone.
"""
import argparse
import csv
import json
import math
import pathlib
import shlex
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
LAYERS = ("emission", "direct", "indirect")
LUMINANCE = (0.2126, 0.7152, 0.0722)
REFERENCE = "path"
# Light paths are cheap and noisy: more VPLs make up for it. The usual bootstrap leaves MIR an error
# of 2 %, common to all pixels.
WAYS = {
    REFERENCE: ["--integrator", "path", "--samples", "64"],
    "mir": ["--sampler", "mir", "--vpls", "1024", "--bootstrap-error", "0.01"],
    "ir": ["--sampler", "ir", "--vpls", "8192"],
    "bir": ["--sampler", "bir", "--vpls", "1024"],
    "micro": ["--integrator", "micro", "--surfels", "2048"],
}
BY_VPLS = ("mir", "ir", "bir")
SHARES = ("removed_share", "removed_share_error", "cut_share", "cut_share_error",
          "non_lambertian_share", "dropped_share")
COLUMNS = ("scene", "options", "integrator", "layer", "seeds", "mean", "standard_error",
           "path_mean", "path_standard_error", "ratio", "difference_percent",
           "difference_error_percent", "z", *SHARES, "seconds", "note")


class Failed(Exception):
    """A render made no picture; the text says why, for the table."""


def render(o, scene, way, seed):
    """The JSON of one render. Four luxels move with the seed, so that pixels are seen everywhere;
    the box filter counts each of them alike, at the border of the picture too."""
    with tempfile.TemporaryDirectory() as folder:
        command = [o.mir, "render", scene, *WAYS[way], "--seed", str(seed), "--width", str(o.width),
                   "--luxels", "4", "--filter", "box", "--direct-samples", str(o.direct_samples),
                   "--backend", "cpu", "--threads", str(o.threads), "--aov", "none", "--no-png",
                   "-o", f"{folder}/a.exr", "--json", "--quiet", *shlex.split(o.options)]
        if o.compensate and way in BY_VPLS:
            command += ["--compensate", str(o.compensate)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=o.limit)
        except subprocess.TimeoutExpired:
            raise Failed(f"takes more than {o.limit:g} s") from None
    if done.returncode != 0:
        said = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
        raise Failed(said[0].removeprefix("mir: ").removeprefix(f"{scene}: ").replace("|", "\\|"))
    return json.loads(done.stdout)


def over_kept(result, name):
    """What is missing over what is there, and its standard error. Reported is the share of both."""
    share, error = result[name] or 0.0, result[name + "_error"] or 0.0
    share = min(share, 0.99)  # where all is missing nothing follows from what is there
    return share / (1 - share), error / (1 - share) ** 2


def layers_of(o, result):
    """Mean luminance of each layer, with what the render says to be missing, and the standard error
    of that addition."""
    light = {layer: (sum(w * c for w, c in zip(LUMINANCE, rgb)), 0.0)
             for layer, rgb in result["mean_radiance"].items()}
    # A limit of --options cuts the path tracer's light too.
    missing = [] if "--bounces" in o.options else [over_kept(result, "cut_share")]
    # A compensated picture has what was removed, and reports the share all the same.
    if not result["residual_paths"]:
        missing.append(over_kept(result, "removed_share"))
    indirect = light["indirect"][0]
    light["indirect"] = (indirect * (1 + sum(m for m, _ in missing)),
                         indirect * math.hypot(*(e for _, e in missing)))
    return light


def student_p(t, degrees):
    """Probability of a |t| as large; finite sums of Abramowitz and Stegun, 26.7.3 and 26.7.4."""
    angle = math.atan(abs(t) / math.sqrt(degrees))
    square = math.cos(angle) ** 2
    odd = degrees % 2
    term = math.sin(angle) * (math.cos(angle) if odd else 1.0)
    total = 0.0
    for k in range(2 + odd, degrees + 1, 2):
        total += term
        term *= square * (k - 1) / k
    return 1 - (2 / math.pi * (angle + total) if odd else total)


def z_of(t, degrees):
    """The normal deviate that is as improbable as Student's t. Sums lose p below 10^-15."""
    p = max(student_p(t, degrees), 1.2e-15)
    return math.copysign(-statistics.NormalDist().inv_cdf(p / 2), t)


def standard_error(values):
    return statistics.stdev(values) / math.sqrt(len(values))


def compare(ours, theirs):
    """A layer of one integrator against that of the path tracer, pairs (light, error) by seed."""
    n = len(ours)
    a, b = [light for light, _ in ours], [light for light, _ in theirs]
    mean, truth = statistics.fmean(a), statistics.fmean(b)
    reported = math.hypot(*(error for _, error in ours)) / n
    error = max(standard_error([x - y for x, y in zip(a, b)]), reported,
                1e-6 * max(abs(mean), abs(truth)))
    row = {"seeds": n, "mean": mean, "standard_error": standard_error(a), "path_mean": truth,
           "path_standard_error": standard_error(b),
           "z": z_of((mean - truth) / error, n - 1) if error > 0 else 0.0}
    if truth > 0:
        row |= {"ratio": mean / truth, "difference_percent": 100 * (mean / truth - 1),
                "difference_error_percent": 100 * error / truth}
    return row


def rows_of(o, scene):
    """All rows of a scene; an integrator that fails has one, without numbers."""
    truth, rows = None, []
    for way in (REFERENCE, *o.integrators):
        head = {"scene": pathlib.Path(scene.removeprefix("builtin:")).name, "options": o.options,
                "integrator": way}
        print(f"{head['scene']}: {way}", file=sys.stderr, flush=True)
        try:
            results = [render(o, scene, way, seed) for seed in range(o.seeds)]
        except Failed as why:
            rows.append(head | {"note": str(why)})
            if way == REFERENCE:
                return rows
            continue
        light = [layers_of(o, result) for result in results]
        truth = truth or light
        for name in SHARES if way in BY_VPLS else ():  # means: an error is that of one render
            head[name] = statistics.fmean(result[name] or 0.0 for result in results)
        head["seconds"] = statistics.fmean(r["seconds"]["total"] for r in results)
        for layer in LAYERS:
            row = compare([x[layer] for x in light], [x[layer] for x in truth])
            if way == REFERENCE:
                row.pop("z")
            rows.append(head | {"layer": layer} | row)
    return rows


def signed(value):
    return f"{value:+.1f}".replace("-", "−")


def verdict(row):
    """A cell: the difference, its standard error and z."""
    if row["path_mean"] == 0:
        return f"{row['mean']:.3g} where the path tracer has none" if row["mean"] else "dark"
    return (f"{signed(row['difference_percent'])} ± {row['difference_error_percent']:.1f} %, "
            f"z {signed(row['z'])}")


def long_table(rows):
    """A row for each layer."""
    lines = ["| Scene | integrator | layer | mean | path tracer | difference, z |",
             "|---|---|---|---:|---:|---|"]
    for row in rows:
        cells = [row["scene"], row["integrator"]]
        if "note" in row:
            cells += ["", "", "", row["note"]]
        elif "z" in row:
            cells += [row["layer"], f"{row['mean']:.4g} ± {row['standard_error']:.1g}",
                      f"{row['path_mean']:.4g} ± {row['path_standard_error']:.1g}", verdict(row)]
        if len(cells) > 2:  # rows of the path tracer itself say nothing new
            lines.append("| " + " | ".join(cells) + " |")
    return lines


def short_table(rows, ways):
    """A row for each scene: what stands out most of each integrator."""
    lines = ["| Scene | " + " | ".join(ways) + " |", "|---" * (len(ways) + 1) + "|"]
    for scene in dict.fromkeys(row["scene"] for row in rows):
        of = [row for row in rows if row["scene"] == scene]
        cells = [scene]
        if "note" in of[0]:  # without a path tracer there is nothing to compare with
            cells += [of[0]["note"], *[""] * (len(ways) - 1)]
        for way in ways if len(cells) == 1 else ():
            most = max((row for row in of if row["integrator"] == way),
                       key=lambda row: (abs(row.get("z", 0.0)), row.get("mean", 0.0)))
            cells.append(most.get("note") or f"{most['layer']} {verdict(most)}")
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def built_in(mir):
    """The built-in scenes. The program lists them when it is asked for one without a name."""
    said = subprocess.run([mir, "info", "builtin:"], capture_output=True, text=True).stderr
    _, found, names = said.partition("choose one of ")
    if not found:
        sys.exit(f"{mir} does not say which scenes it has: {said.strip()}")
    return ["builtin:" + name.strip() for name in names.split(",")]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    add = parser.add_argument
    add("files", nargs="*", metavar="FILE", help="scenes")
    add("--built-in", action="store_true", help="every built-in scene instead")
    add("--integrators", default="mir,ir,bir,micro", help="which (%(default)s)")
    add("--seeds", type=int, default=6, help="renders of each (%(default)s)")
    add("--width", type=int, default=24, help="pixels across (%(default)s)")
    add("--limit", type=float, default=60, help="seconds that a render may take (%(default)s)")
    add("--direct-samples", type=int, default=64, help="lamp samples per pixel (%(default)s)")
    add("--options", default="", help="more options of mir render, for all")
    add("--compensate", type=int, default=0, metavar="N",
        help="paths per pixel that trace back what the bound removed")
    add("--threads", type=int, default=1, help="of a render (%(default)s)")
    add("--mir", default=str(ROOT / "build/cpu/bin/mir"), help="the program")
    add("--rows", action="store_true", help="print every layer")
    add("--csv", help="file for all numbers")
    o = parser.parse_args()
    o.integrators = o.integrators.split(",")
    strange = [way for way in o.integrators if way not in WAYS or way == REFERENCE]
    lost = [f for f in o.files if not f.startswith("builtin:") and not pathlib.Path(f).is_file()]
    if o.built_in == bool(o.files):
        parser.error("name files, or --built-in and none")
    if strange:
        parser.error(f"--integrators: there is no '{strange[0]}'; choose among "
                     + ", ".join(way for way in WAYS if way != REFERENCE))
    if lost:
        parser.error(f"{lost[0]}: there is no such file")
    if o.seeds < 2:
        parser.error("--seeds: one render has no standard error; ask for 2 or more")
    if not pathlib.Path(o.mir).is_file():
        parser.error(f"{o.mir}: there is no such program; build it, or name another with --mir")
    return o


def main():
    o = arguments()
    rows = []
    for scene in built_in(o.mir) if o.built_in else o.files:
        rows += rows_of(o, scene)
        if o.csv:  # after each scene: a long run that is stopped leaves what it found
            with open(o.csv, "w", newline="", encoding="utf-8") as file:
                writer = csv.DictWriter(file, COLUMNS)
                writer.writeheader()
                writer.writerows(rows)
    print("\n".join(long_table(rows) if o.rows else short_table(rows, o.integrators)))


if __name__ == "__main__":
    main()
