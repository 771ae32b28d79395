# SPDX-License-Identifier: MIT
"""The page with all tables."""
import tables


def heading(scene, layer):
    return f"{scene}, {'indirect light alone' if layer == 'indirect' else 'whole picture'}"


SECONDS = {"cpu_seconds": "CPU seconds, user and system of the whole process,",
           "wall_seconds": "Seconds of the whole process by the clock"}


def introduction(metric, clock, levels):
    worst = ", without the worst 0.5 % of the pixels" if metric == "relmse_trimmed" else ""
    return ["# Error against time", "",
            f"{SECONDS[clock]} until the scaled relMSE{worst} is "
            f"{', '.join(f'{level:g}' for level in levels)}: interpolated in log-log between the "
            "pictures of a configuration. ≤: its quickest picture is already better. Not told: "
            "the references are too noisy; more `--reference-paths` help. Slope: "
            "exponent of the error as a power of the seconds over the last two pictures. The best "
            "of a group is chosen afterwards, level by level. Whole pictures and their indirect "
            "light come of the same renders, so the seconds of indirect light include the direct.",
            ""]


def write(path, results, left_out, metric, clock, levels):
    """`results`: rows and the references' own errors, by (scene, layer)."""
    lines = introduction(metric, clock, levels)
    for (scene, layer), (rows, own_error) in results.items():
        lines += [f"## {heading(scene, layer)}", "",
                  f"{rows[0].width} × {rows[0].height} pixels. The references' own scaled relMSE "
                  f"is {own_error:.2g} each, which the estimate leaves out; errors below "
                  f"{smallest_error(own_error):.2g} they do not tell.", ""]
        found = tables.curves_of(rows, metric, clock)
        lines += [*tables.level_table(found, levels, smallest_error(own_error)), ""]
    if left_out:
        lines += ["## Left out", "", *(f"* {scene}: {name}: {reason}"
                                       for scene, name, reason in left_out), ""]
    path.write_text("\n".join(lines), encoding="utf-8")


def smallest_error(own_error):
    """Below this the references' noise decides what is measured.

    In the product of two differences it averages out, but for noise of the mean, a hundredth or
    less. The scale, the mean of both, is noisy too: relative variances v make the error of a
    perfect picture 1.5 v^2, to second order, which is above the square of their mean.
    """
    return max(own_error / 100.0, 1.5 * own_error ** 2, 1e-12)
