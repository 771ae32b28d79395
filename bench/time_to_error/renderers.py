# SPDX-License-Identifier: MIT
"""The programs that draw the pictures of a configuration, and which of them are there."""
import pathlib
import sys

import measure

HERE = pathlib.Path(__file__).resolve().parent
GUIDED = "direct,indirect,emission,albedo,normal"  # what mir denoise reads


class LeftOut(Exception):
    """A configuration cannot be measured here; the message is the reason."""


class Renderers:
    """Draws pictures of one scene."""

    def __init__(self, job, folder, missing):
        self._job, self._folder, self._missing = job, folder, missing
        self._mitsuba_scene = None

    def layers(self, configuration):
        """What can be measured of its pictures."""
        has_layers = configuration.program == "mir" and not configuration.denoise
        return ["whole", "indirect"] if has_layers else ["whole"]

    def check(self, configuration):
        """Raises LeftOut where a program or a module is missing, or the scene is not for it."""
        if configuration.program != "mitsuba":
            return
        if configuration.denoise and "pyoidn" in self._missing:
            raise LeftOut(self._missing["pyoidn"])
        if "mitsuba" in self._missing:
            raise LeftOut(self._missing["mitsuba"])
        self._convert()

    def draw(self, configuration, value, seed, picture):
        """Writes the picture. Returns what it cost."""
        options = configuration.options_at(value)
        if configuration.program == "mitsuba":
            return self._draw_by_mitsuba(configuration, options, seed, picture)
        options = [*options, "--seed", seed]
        if not configuration.denoise:
            return measure.run(self._job.render(picture, options))[0]
        noisy = picture.with_suffix(".noisy.exr")
        cost = measure.run(self._job.render(noisy, options, GUIDED))[0]
        return cost + measure.run([self._job.mir, "denoise", noisy, picture, "--quiet"])[0]

    def _draw_by_mitsuba(self, configuration, options, seed, picture):
        command = [sys.executable, HERE / "mitsuba_render.py", self._convert(), picture,
                   "--width", self._job.width, "--height", self._job.height,
                   "--paths", *options, "--seed", seed]
        return measure.run(command + ["--denoise"] * configuration.denoise)[0]

    def _convert(self):
        """The scene for Mitsuba, written once."""
        if self._mitsuba_scene:
            return self._mitsuba_scene
        if self._job.options or self._job.environment:
            raise LeftOut("options of mir that Mitsuba does not know are given")
        import mitsuba_scene  # needs numpy, as Mitsuba does
        folder = self._folder / (self._job.name + "-mitsuba")
        folder.mkdir(parents=True, exist_ok=True)
        glb = folder / "scene.glb"
        measure.run([self._job.mir, "export", self._job.scene, "-o", glb])
        try:
            self._mitsuba_scene = mitsuba_scene.convert(glb, folder)
        except mitsuba_scene.Unsupported as reason:
            raise LeftOut(f"the scene is not for Mitsuba: {reason}") from reason
        return self._mitsuba_scene


def missing_programs():
    """Reasons by name of what this Python cannot run."""
    reasons = {}
    for name, command, remedy in (
            ("mitsuba", [HERE / "mitsuba_render.py", "--check"], "install mitsuba and numpy from "
             "PyPI, and LLVM 19 or newer, its library named by DRJIT_LIBLLVM_PATH"),
            ("pyoidn", ["-c", "import pyoidn"], "install pyoidn and numpy from PyPI")):
        try:
            measure.run([sys.executable, *command])
        except measure.Failed as failure:
            reason = str(failure).split(": ", 1)[1]
            reasons[name] = f"{name} does not run ({reason}); {remedy}"
    return reasons
