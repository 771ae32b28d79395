# SPDX-License-Identifier: MIT
"""Ways to draw a picture, each with a number that grows along its curve."""
import dataclasses
import shlex

GROWING = "{}"  # stands for the value in options
MOST_LUXELS = 64  # of a pixel; more paths than these share luxels
QUALITIES = {1: "draft", 2: "good", 3: "final"}  # of mir render, by the value


@dataclasses.dataclass(frozen=True)
class Configuration:
    """A curve of error against time."""
    name: str
    group: str  # those whose best is told
    values: tuple  # from the fastest picture to the best
    options: tuple  # of mir render, or of the program of Mitsuba
    program: str = "mir"  # or "mitsuba"
    denoise: bool = False  # by Open Image Denoise

    def options_at(self, value):
        """Options with the value in its place, and for paths with what it is made of."""
        places = {GROWING: value, "{luxels}": min(value, MOST_LUXELS),
                  "{samples}": max(1, value // MOST_LUXELS),
                  "{quality}": QUALITIES.get(value, "good")}
        words = list(self.options)
        for place, number in places.items():
            words = [word.replace(place, str(number)) for word in words]
        return words


def of_mir(name, group, values, options, denoise=False):
    return Configuration(name, group, tuple(values), tuple(shlex.split(options)), "mir", denoise)


def qualities():
    """What mir render does without further options."""
    yield of_mir("quality", "quality", QUALITIES, "--quality {quality}")
    yield of_mir("quality, denoised", "quality, denoised", QUALITIES, "--quality {quality}",
                 denoise=True)


def all_pairs():
    for luxels in (1, 4):
        yield of_mir(f"all pairs, luxels {luxels}", "all pairs", (64, 256, 1024, 4096, 16384),
                     f"--sum all --luxels {luxels} --vpls {GROWING}")
    yield of_mir("all pairs, luxels 4, direct samples 256", "all pairs", (256, 1024, 4096, 16384),
                 f"--sum all --luxels 4 --direct-samples 256 --vpls {GROWING}")
    yield of_mir("all pairs, luxels 4, denoised", "all pairs, denoised", (64, 256, 1024, 4096),
                 f"--sum all --luxels 4 --vpls {GROWING}", denoise=True)


def cuts():
    """Picks grow: their variance falls, and what is left is the error of these VPLs."""
    picks = (16, 64, 256, 1024, 4096)
    for sampler, luxels, vpls in (("ir", 1, 16384), ("ir", 1, 65536), ("ir", 1, 262144),
                                  ("ir", 4, 16384), ("ir", 4, 65536), ("ir", 4, 262144),
                                  ("ir", 4, 1048576), ("mir", 4, 16384), ("mir", 4, 65536)):
        yield of_mir(f"cuts by {sampler}, luxels {luxels}, VPLs {vpls}", "cuts", picks,
                     f"--sum cuts --sampler {sampler} --luxels {luxels} --vpls {vpls} "
                     f"--picks {GROWING}")
    yield of_mir("cuts by ir, luxels 4, VPLs 65536, denoised", "cuts, denoised", picks,
                 f"--sum cuts --sampler ir --luxels 4 --vpls 65536 --picks {GROWING}",
                 denoise=True)


def paths():
    options = "--integrator path --luxels {luxels} --samples {samples}"
    yield of_mir("path tracer", "path tracer", (1, 4, 16, 64, 256), options)
    yield of_mir("path tracer, denoised", "path tracer, denoised", (1, 4, 16, 64), options,
                 denoise=True)


def mitsuba():
    yield Configuration("Mitsuba, path", "Mitsuba", (1, 4, 16, 64, 256), (GROWING,), "mitsuba")
    yield Configuration("Mitsuba, path, denoised", "Mitsuba, denoised", (1, 4, 16, 64),
                        (GROWING,), "mitsuba", denoise=True)


def standard():
    """What is measured where nothing else is asked for."""
    return [*qualities(), *all_pairs(), *cuts(), *paths(), *mitsuba()]


def quick():
    """Two curves of two points, for a test."""
    return [of_mir("all pairs", "all pairs", (16, 64), f"--luxels 1 --vpls {GROWING}"),
            of_mir("path tracer", "path tracer", (1, 4),
                   "--integrator path --luxels {luxels} --samples {samples}")]


def parsed(text):
    """A configuration of the command line: NAME: VALUES: OPTIONS."""
    parts = [part.strip() for part in text.split(":", 2)]
    if len(parts) < 3 or not parts[0] or GROWING not in parts[2]:
        raise ValueError(f"'{text}' is not 'NAME: VALUE,VALUE: OPTIONS' with {GROWING} in the "
                         "options (the value that grows takes its place); write for example "
                         "'cuts 32: 1024,4096: --sum cuts --picks 32 --vpls {}'")
    name, values, options = parts
    return of_mir(name, name.split(",")[0], sorted(int(v) for v in values.split(",")), options)
